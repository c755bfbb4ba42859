"""Figures of whole wells, and of tubing in them."""
