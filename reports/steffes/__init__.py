"""The report on Steffes 2014."""
