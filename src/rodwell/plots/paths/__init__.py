"""Figures of load paths: what happens beyond lift-off, and on the way back."""
