"""What is written into a folder of results."""
