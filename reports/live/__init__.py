"""No report: the figures that `sched-sim live` draws."""
