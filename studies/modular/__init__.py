"""Modular filters tried: the oscillator, the rocket, late measurements, their costs and consistency."""
