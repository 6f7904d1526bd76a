"""The report on modular filters."""
