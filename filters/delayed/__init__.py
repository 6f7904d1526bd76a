"""Filters of delayed measurements: those of Steffes 2014, and what others fly."""
