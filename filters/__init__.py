"""Estimation with delayed measurements; knows nothing of scheduling."""
