"""What the figures of a design rest on: its costs, tasks, and what is meant by accuracy and by the cheapest part."""

from __future__ import annotations

from collections.abc import Iterator

from sched_sim.costs.table import units
from sched_sim.processors.ground import calibration_texts, ground
from sched_sim.text import visible
from studies.explorer.answer import DesignFound


def grounds(found: DesignFound) -> tuple[str, ...]:
    """One line each."""
    return (*_costs(found), *_tasks(found), *_accuracy(found), *_parts(found))


def _costs(found: DesignFound) -> Iterator[str]:
    counts, method = found.asked.counts, found.plan.method
    rests = ""
    if counts.operations:
        parts = [on.part for on in found.parts if on.part is not None]
        known = calibration_texts(counts, parts if found.asked.part is None else [found.asked.part])
        rests = f": {ground(counts, [method], known)}" if known else ""
    yield f"costs: {counts.name}, in {units(counts.unit)}{rests}"


def _tasks(found: DesignFound) -> Iterator[str]:
    if names := ", ".join(visible(task.name) for task in found.asked.tasks):
        yield f"beside it run {names}"


def _accuracy(found: DesignFound) -> Iterator[str]:
    outputs = found.asked.outputs
    if found.figures is not None and outputs is not None:
        which = (
            "in the worst step of a cycle" if found.asked.design.metric == "worst" else "root mean square over a cycle"
        )
        yield f"accuracy: one standard deviation of {outputs.name}, {which}, exact for a linear model"


def _parts(found: DesignFound) -> Iterator[str]:
    if any(on.part is not None for on in found.parts):
        yield "parts: the cheapest first where prices are known, else the one with the least to spare"
