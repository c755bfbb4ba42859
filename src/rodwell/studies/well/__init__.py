"""A well, station by station."""
