"""Beyond lift-off: how a branch that was followed on the wall goes on off it."""
