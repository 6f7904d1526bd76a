"""The figure that `sched-sim probability` draws."""
