"""The one door for people: `sched-sim`. Each command imports what it needs when it runs."""

from __future__ import annotations

import sys


def main() -> None:
    """Run `sched-sim`; what the user can mend ends with exit code 2 and one message on standard error."""
    try:
        from sched_sim.cli.streams import run

        code = run()
    except KeyboardInterrupt:  # while modules are imported, too
        code = 130
    sys.exit(code)
