"""Load paths: what happens as the load grows quasi-statically and comes back."""
