"""From one equilibrium to the next, and what happens between them."""
