"""A pair of fields in a disc, alternately in contact with its rim and free: stretches whose ends are unknowns."""
