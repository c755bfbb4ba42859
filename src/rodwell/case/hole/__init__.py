"""[hole] and [cylinder] of a case."""
