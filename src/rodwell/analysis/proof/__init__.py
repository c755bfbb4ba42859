"""Loads with proof, by ball arithmetic."""
