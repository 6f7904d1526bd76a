"""What the costs, the part, the model and the tasks of a design are called outside the explorer."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

from sched_sim.costs.table_file import shipped_tables
from studies.explorer.resolved import Resolved


@dataclass(frozen=True, slots=True)
class Sources:
    """As on a command line: shipped ones by name, files by path, functions as package.module:function.

    costs: None for the table that is meant where none is named; counting: the arguments of `sched-sim measure` that
    write it, where it was counted for the model.
    """

    costs: str | None
    counting: tuple[str, ...]
    part: str | None
    model: str | None
    tasks: str | None


_shipped = cache(shipped_tables)


def sources_of(asked: Resolved) -> Sources | None:
    """None where one of them has no such name: it was made in Python."""
    design, given = asked.design, asked.given
    costs = _costs(asked)
    part, model = design.processor, design.model
    if part is not None and part in given.parts:
        part = given.parts[part].path
    if model is not None and model in given.models and ":" not in model:
        model = ""
    tasks = str(given.tasks) if isinstance(given.tasks, Path) else "" if given.tasks else None
    if "" in (costs, part, model, tasks):
        return None
    return Sources(costs, _counting(asked, costs), part, model, tasks)


def _costs(asked: Resolved) -> str | None:
    name, counts = asked.design.costs, asked.counts
    if name is not None:
        return asked.given.costs[name].path if name in asked.given.costs else name
    if asked.model is None:
        return None
    return counts.name if counts.name in _shipped() else f"{counts.name}.toml"


def _counting(asked: Resolved, costs: str | None) -> tuple[str, ...]:
    if asked.model is None or asked.design.costs is not None or asked.counts.name in _shipped():
        return ()
    sizes = zip(("--states", "--inputs", "--measurements"), map(str, asked.model.sizes), strict=True)
    of = [word for pair in sizes for word in pair]
    if asked.model.system is not None:
        of = ["--system", asked.model.name]
    return (*of, "--backend", "counted", "-o", str(costs))
