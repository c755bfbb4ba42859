"""What is computed for a case."""
