"""The answer to a case."""
