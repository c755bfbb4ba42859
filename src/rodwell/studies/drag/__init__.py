"""A whole well: how much of the force at one end of a string arrives at the other."""
