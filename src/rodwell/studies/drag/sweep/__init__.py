"""Parameter studies of torque and drag: the file of a well with lists or ranges."""
