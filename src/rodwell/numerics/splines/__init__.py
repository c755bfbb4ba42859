"""Splines: spaces, what ends hold, products in registers, assembly, banded matrices."""
