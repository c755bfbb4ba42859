"""The rod kept on the wall: its energy, stated once, and the fields that follow from it."""
