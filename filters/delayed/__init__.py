"""Filters of delayed measurements: standard, recalculate, Larsen, dual-rate, stochastic cloning, carried gain."""
