"""`python -m sched_sim` is the command `sched-sim`."""

import sys

if not sys.flags.safe_path:
    sys.path.append(sys.path.pop(0))  # the current folder is searched last: a file numba.py there hides no library

from sched_sim.cli import main

main()
