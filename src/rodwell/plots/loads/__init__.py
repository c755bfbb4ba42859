"""Pictures of single loads: how they change, when modes switch, what twist does."""
