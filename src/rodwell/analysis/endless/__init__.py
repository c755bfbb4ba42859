"""The rod without ends on the wall: its periodic states, their loads and stability, and a table of them."""
