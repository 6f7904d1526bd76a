"""A scenario simulated by compiled code: the rules of `sched_sim.scenario` once more, on whole numbers in one array."""
