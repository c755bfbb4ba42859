"""What a number is: its name, unit, scale, error, and how it is written."""
