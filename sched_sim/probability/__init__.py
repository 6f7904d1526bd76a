"""Probabilities of misses and late landings, computed from distributions of execution times and not sampled."""
