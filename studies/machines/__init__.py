"""Measurements by machine: kept in the repository, read back, and the range of a figure over them."""
