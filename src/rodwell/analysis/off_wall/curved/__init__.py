"""States off the wall of a curved hole: the rod there as a model, and states with every section at its own place."""
