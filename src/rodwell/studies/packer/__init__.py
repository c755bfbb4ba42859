"""Tubing in a packer: how its length changes with pressure, temperature and fluids, and what the packer must hold."""
