"""What a delayed measurement is worth at the output: exact covariances, by age. No schedule, only where it lands."""
