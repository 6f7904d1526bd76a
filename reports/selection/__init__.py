"""No report: the figure that `sched-sim design` draws."""
