"""Equilibria of a rod that may leave the wall: patterns of contact, states, what follows from them."""
