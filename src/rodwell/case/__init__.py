"""A case: what the user has, with units, checked and made dimensionless."""
