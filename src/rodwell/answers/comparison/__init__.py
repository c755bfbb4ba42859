"""Formulas of practice beside exact loads."""
