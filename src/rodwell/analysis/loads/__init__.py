"""What loads depend on; loads of long rods."""
