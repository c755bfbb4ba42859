"""How kernels are compiled, kept on disk, and made ready on a first run."""
