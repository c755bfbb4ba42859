"""Where rod meets solver: families of equilibria, first meshes, what is measured."""
