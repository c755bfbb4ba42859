"""The rod in space: frames, surfaces, and the scene that all pictures share."""
