"""The one door for people: `sched-sim`. Each command imports what it needs when it runs."""

from __future__ import annotations

import os
import sys


def main() -> None:
    """Run `sched-sim`; what the user can mend ends with exit code 2 and one message on standard error."""
    from sched_sim.cli.app import app
    from sched_sim.errors import InputError

    try:
        app(prog_name="sched-sim")
    except InputError as error:
        print(f"Error: {error}", file=sys.stderr)
        sys.exit(2)
    except BrokenPipeError:  # `sched-sim ... | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)
