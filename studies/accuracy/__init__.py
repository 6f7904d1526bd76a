"""What late measurements cost at the output: the shipped models, all methods, and a processor that is slow."""
