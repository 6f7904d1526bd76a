"""Adds this machine to the store of measurements: `python -m studies.machines`, up to four minutes on an idle machine.

With the paths of cost tables, such as those in the folders of reports, it adds these, and measures nothing.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from filters.systems.example import example_system
from sched_sim.costs.methods import PAPER_METHODS
from sched_sim.costs.table import CostTable, busy_note
from sched_sim.costs.table_file import read_costs
from sched_sim.errors import InputError
from sched_sim.files.toml_reader import read_text
from studies.machines.parts import NAME as PARTS
from studies.machines.parts import PartTimes, keep_parts, part_times, read_parts
from studies.machines.store import keep
from studies.measurement.methods import measure
from studies.modular.costs import times
from studies.modular.flight_times import NAME as FLIGHTS
from studies.modular.flight_times import flight_times
from studies.robust.costs import SYSTEMS, robust_costs


def measured_here() -> Iterator[CostTable | PartTimes]:
    """What the reports steffes2014, erkf and modular time."""
    yield measure(example_system(9, 3, 3), name="measured-9-3-3", methods=PAPER_METHODS)
    for name in SYSTEMS:
        yield robust_costs(name, "compiled")
    yield part_times(times())
    yield part_times(flight_times(), FLIGHTS)


def _read(path: Path) -> CostTable | PartTimes:
    text = read_text(path, f"measurement {str(path)!r}", "give the path of a TOML file")
    is_of_parts = any(f'name = "{name}"' in text.splitlines() for name in (PARTS, FLIGHTS))
    return read_parts(path) if is_of_parts else read_costs(path)


def main(paths: list[str]) -> int:
    """The exit code: 2 for what the user can mend."""
    try:
        for measured in map(_read, map(Path, paths)) if paths else measured_here():
            if note := busy_note(measured.provenance):
                print(note, file=sys.stderr)
            print(keep(measured) if isinstance(measured, CostTable) else keep_parts(measured))
    except InputError as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
