"""The ways to run kernels and jobs: as they are, compiled, counted, by NumPy calls."""
