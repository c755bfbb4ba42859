"""Whole studies made of many computations: what is computed, as data; drawings and tables lie above."""
