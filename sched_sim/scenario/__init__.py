"""A filter of several sensors on a processor: the scenario, its jobs, its run, what it asks for."""
