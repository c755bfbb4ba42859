"""Splines, banded solver, eigenvalues, continuation, events. Knows no rod."""
