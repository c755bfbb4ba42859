"""Where something happens, in two parameters."""
