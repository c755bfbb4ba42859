"""Rods off a wall whose clearance varies smoothly."""
