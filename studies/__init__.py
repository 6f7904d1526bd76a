"""What is asked: cost measurement, sweeps and the declared studies."""
