"""Critical loads, branches, stability, lift-off: where rod meets solver."""
