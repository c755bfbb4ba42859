"""Parameter studies: a case file with lists or ranges."""
