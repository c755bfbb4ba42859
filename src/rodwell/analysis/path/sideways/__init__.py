"""Loads at which strings that are off the wall before they buckle do so, out of their plane."""
