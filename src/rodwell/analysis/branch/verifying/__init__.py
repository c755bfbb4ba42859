"""States and loads of a branch once more, by another program."""
