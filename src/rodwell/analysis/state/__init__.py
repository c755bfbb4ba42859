"""One equilibrium as a record, and what is computed of it."""
