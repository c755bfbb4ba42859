"""The answer as tables and as plain data."""
