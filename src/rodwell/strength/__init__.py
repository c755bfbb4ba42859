"""Stress and strength of rod, cylinder and supports in a state."""
