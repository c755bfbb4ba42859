"""What an answer means, in sentences."""
