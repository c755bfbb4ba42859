"""The energy of a rod that may leave the wall: two lateral fields, and what follows from it; no solver."""
