"""What runs on a processor: jobs and tasks, the simulated processor itself, its outcome and its trace."""
