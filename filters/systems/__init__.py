"""What is estimated: a system model is a record of functions and their parameters."""
