"""The dimensionless problem: what the mathematics needs, and nothing else."""
