"""The engineer's side: case files, units, answers, what they mean."""
