"""Whole grids of designs: axes, rows, the results store, workers, export."""
