"""On what ground verdicts on parts by counted operations rest: of which update they are, and what was measured."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.costs.table import CostTable
from sched_sim.processors.part import Part, calibration_for


def ground(table: CostTable, methods: Iterable[str], calibrations: Mapping[str, str | None]) -> str:
    """In words; empty for instructions. calibrations: of each part by its name, None if it has none."""
    if table.target is not None:
        return ""
    forms = update_forms(table, methods)
    sparse = table.structure == "sparse"
    unknown_form = "sparse counts" if sparse else "operations as counted"
    counts = f"{table.structure} counts, {forms[0]} form" if forms else unknown_form
    known = [f"{text} on {name}" for name, text in calibrations.items() if text]
    measured = f"measured over predicted {', '.join(known) or 'is not known'}"
    return f"{counts}; {_of_sparse(calibrations, measured if known else '') if sparse else measured}"


def calibration_texts(table: CostTable, parts: Iterable[Part]) -> dict[str, str | None]:
    """Of each part by its name, what was measured of such code as the table counts."""
    known = {part.name: calibration_for(table, part) for part in parts}
    return {name: None if calibration is None else calibration.text for name, calibration in known.items()}


def update_forms(table: CostTable, methods: Iterable[str]) -> list[str]:
    """The form of the covariance update that the costs of each method are of, without those that keep factors of it and
    those of which the table does not say it."""
    form = table.update_form
    return [form for method in methods if form is not None and method in DELAYED_METHODS]


def _of_sparse(calibrations: Mapping[str, str | None], measured: str) -> str:
    """measured: of the parts on which sparse code was timed; empty if it was on none."""
    others = [name for name, text in calibrations.items() if not text]
    if not others:
        return measured
    where = "the others" if measured else ", ".join(others)
    unknown = f"no published timing of sparse code on {where}: the range is not known"
    return f"{measured}; {unknown}" if measured else unknown
