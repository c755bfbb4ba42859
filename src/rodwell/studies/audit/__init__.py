"""Formulas of practice held against the exact loads."""
