"""What a file of a whole well may hold, and how it is read."""
