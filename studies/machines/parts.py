"""Measurements by machine of composed filters, which are no methods and so have no cost table: of their parts, and of
whole flights.

A file of the store has the form of a cost table; a part has its least and its median time in µs, of which older
measurements know no more.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple, TypeAlias

from sched_sim.errors import InputError
from sched_sim.files.toml_reader import read_toml
from sched_sim.files.toml_writer import toml_tables, toml_value
from sched_sim.files.writable import write
from studies.machines.store import FOLDER, files, place
from studies.modular.costs import Times

NAME, UNIT = "modular-parts", "us"
SOURCE = "means over the repetitions of a round; minimum and median over rounds"

PartName: TypeAlias = tuple[str, str, str]
"""Its kind, how many states, and predict or correct; of a flight the kind of its predictor, the states, and the way to
run it."""


class Micros(NamedTuple):
    """The least and the median time of a part, in µs."""

    least: float
    median: float


class PartTimes(NamedTuple):
    """One measurement. provenance: the machine, the date, the versions, the protocol, and that it was busy if so. name:
    what the store calls such measurements."""

    provenance: Mapping[str, Any]
    parts: Mapping[PartName, Micros]
    name: str = NAME


def part_times(timed: Times, name: str = NAME) -> PartTimes:
    """To three digits: more would be noise."""
    parts: dict[PartName, Micros] = {
        key: Micros(*(float(f"{1e6 * time:.3g}") for time in (min(rounds), median(rounds))))
        for key, rounds in timed.seconds.items()
    }
    return PartTimes({"source": SOURCE, **timed.about}, parts, name)


def parts_text(measured: PartTimes) -> str:
    """As `read_parts` reads it back."""
    lines, sections = [f"name = {toml_value(measured.name)}", f"unit = {toml_value(UNIT)}"], []
    for key, value in measured.provenance.items():
        if isinstance(value, Mapping):
            sections += toml_tables(key, value)
        else:
            lines.append(f"{key} = {toml_value(value)}")
    by_filter: dict[str, dict[str, dict[str, float]]] = {}
    for (kind, states, part), micros in measured.parts.items():
        by_filter.setdefault(f"{kind}-{states}", {})[part] = {"minimum": micros.least, "median": micros.median}
    return "\n".join([*lines, *sections, *toml_tables("costs", by_filter)]) + "\n"


def read_parts(path: Path) -> PartTimes:
    """Raises InputError if the file is not there, is no TOML, or holds no times of parts."""
    document = read_toml(path, f"times of parts {str(path)!r}", "give the path of one that this program wrote")
    try:
        name = str(document["name"])
        about = {key: value for key, value in document.items() if key not in ("name", "unit", "costs")}
        parts: dict[PartName, Micros] = {}
        for of_filter, costs in document["costs"].items():
            kind, states = of_filter.split("-")
            for part, cost in costs.items():
                parts[kind, states, part] = Micros(float(cost["minimum"]), float(cost["median"]))
    except (KeyError, ValueError, TypeError, AttributeError):
        raise InputError(f"{path} holds no times of parts: give a file that this program wrote") from None
    return PartTimes(about, parts, name)


def kept_parts(folder: Path = FOLDER, name: str = NAME) -> tuple[PartTimes, ...]:
    """All measurements of this name, the oldest first."""
    return tuple(read_parts(path) for path in files(name, folder))


def keep_parts(measured: PartTimes, folder: Path = FOLDER) -> Path:
    """Adds a measurement, unless it is there; the path of its file.

    Raises InputError for one of other parts than those that are kept, and if the folder cannot be written.
    """
    for path in files(measured.name, folder):
        other = read_parts(path)
        if other == measured:
            return path
        if other.parts.keys() != measured.parts.keys():
            raise InputError(f"{measured.name}: these are not times of the parts that {path} has")
    path = place(measured.name, str(measured.provenance["machine"]), str(measured.provenance["date"]), folder)
    write(path, parts_text(measured).encode(), "times of parts")
    return path


def parts_beside(measured: PartTimes, stored: Sequence[PartTimes]) -> tuple[PartTimes, ...]:
    """Those that are stored and this one, which may be among them."""
    return (*(one for one in stored if one != measured), measured)
