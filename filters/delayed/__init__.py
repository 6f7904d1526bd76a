"""Filters of delayed measurements: standard, recalculate, Larsen, dual-rate."""
