"""The store of measurements: a folder for each cost table, a file for each time that it was measured on some machine.

Files are named by machine and date, NAME/MACHINE-DATE.toml, and -2, -3 ... behind it where that machine measured more
than once that day. Each is the cost table as it was written then.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import read_costs, write_costs
from sched_sim.errors import InputError

FOLDER = Path(__file__).parents[1] / "data" / "measurements"

OF_THE_TIME = frozenset({"source", "busy", "machine", "date", "versions", "protocol"})
"""What may be said otherwise of two measurements of the same jobs."""


def kept(name: str, folder: Path = FOLDER) -> tuple[CostTable, ...]:
    """All measurements of the cost table of this name, the oldest first; none if there is no such table.

    Raises InputError that lists every wrong entry of a file.
    """
    return tuple(read_costs(path) for path in files(name, folder))


def files(name: str, folder: Path = FOLDER) -> list[Path]:
    """Where they are, in the same order."""
    return sorted((folder / name).glob("*.toml"), key=_when)


def keep(table: CostTable, folder: Path = FOLDER) -> Path:
    """Adds a measurement, unless it is there; the path of its file.

    Raises InputError for a table that was not timed, for one of other jobs than those that are kept under its name, and
    if the folder cannot be written.
    """
    if not {"machine", "date", "protocol"} <= table.provenance.keys():
        raise InputError(
            f"cost table {table.shown} does not say on which machine and when it was timed: give one that was timed"
        )
    for path in files(table.name, folder):
        other = read_costs(path)
        if is_same(table, other):
            return path
        _check_comparable(table, other)
    path = place(table.name, str(table.provenance["machine"]), str(table.provenance["date"]), folder)
    write_costs(table, path)
    return path


def place(name: str, machine: str, date: str, folder: Path = FOLDER) -> Path:
    """A path for one more measurement, its folder made."""
    of_name = folder / name
    of_name.mkdir(parents=True, exist_ok=True)
    stem = f"{re.sub('[^a-z0-9]+', '-', machine.lower()).strip('-')}-{date}"
    number, path = 1, of_name / f"{stem}.toml"
    while path.exists():
        number += 1
        path = of_name / f"{stem}-{number}.toml"
    return path


def is_same(table: CostTable, other: CostTable) -> bool:
    """Whether they are one measurement."""
    return (table.costs, table.provenance) == (other.costs, other.provenance)


def beside(measured: CostTable, stored: Sequence[CostTable]) -> tuple[CostTable, ...]:
    """Those that are stored and this one, which may be among them."""
    return (*(table for table in stored if not is_same(table, measured)), measured)


def _when(path: Path) -> tuple[str, int, str]:
    date, number = re.search(r"(\d{4}-\d\d-\d\d)(?:-(\d+))?$", path.stem).groups()  # type: ignore[union-attr]
    return date, int(number or 1), path.stem


def _check_comparable(table: CostTable, other: CostTable) -> None:
    one, two = _jobs_of(table), _jobs_of(other)
    for key in sorted(one.keys() | two.keys()):
        if one.get(key) != two.get(key):
            raise InputError(
                f"cost table {table.shown} has {key} = {one.get(key)!r} where {other.path} has {two.get(key)!r}: these "
                f"are not times of the same jobs; give the table another name"
            )
    missing = [f"{method} {job}" for method, jobs in other.costs.items() for job in jobs if not table.has(method, job)]
    if missing:
        raise InputError(f"cost table {table.shown} lacks jobs that {other.path} has: {', '.join(missing)}")


def _jobs_of(table: CostTable) -> dict[str, Any]:
    """What was timed, in words. Old tables do not say that they are dense; of a compiler, its flags."""
    said = {key: value for key, value in table.provenance.items() if key not in OF_THE_TIME}
    compiler = {"compiler": str(said["compiler"]).partition(", ")[2]} if "compiler" in said else {}
    return {**said, "unit": table.unit, "structure": table.structure, **compiler}
