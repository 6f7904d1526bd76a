"""`python -m sched_sim` is the command `sched-sim`."""

from sched_sim.cli import main

main()
