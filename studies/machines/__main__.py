"""Adds this machine to the store of measurements: `python -m studies.machines`, up to three minutes on an idle machine.

With the paths of cost tables, such as those in the folders of reports, it adds these, and measures nothing.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator

from filters.systems.example import example_system
from sched_sim.costs.methods import PAPER_METHODS
from sched_sim.costs.table import CostTable, busy_note
from sched_sim.costs.table_file import read_costs
from sched_sim.errors import InputError
from studies.machines.store import keep
from studies.measurement.methods import measure
from studies.robust.costs import SYSTEMS, robust_costs


def measured_here() -> Iterator[CostTable]:
    """The tables of the reports steffes2014 and erkf."""
    yield measure(example_system(9, 3, 3), name="measured-9-3-3", methods=PAPER_METHODS)
    for name in SYSTEMS:
        yield robust_costs(name, "compiled")


def main(paths: list[str]) -> int:
    """The exit code: 2 for what the user can mend."""
    try:
        for table in map(read_costs, paths) if paths else measured_here():
            if note := busy_note(table.provenance):
                print(f"{table.name}: {note}", file=sys.stderr)
            print(keep(table))
    except InputError as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
