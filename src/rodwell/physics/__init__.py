"""The energy, the braid, contact. Knows no solver."""
