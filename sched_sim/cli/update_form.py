"""What the costs are of: which covariance update, which matters as much as the method; whether zeros are multiplied;
and on what ground."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from sched_sim.cli.instructions import target_note
from sched_sim.cli.measured_note import busy_note
from sched_sim.cli.output import lines
from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.costs.table import CostTable

if TYPE_CHECKING:
    from sched_sim.processors.part import Part

MEASURE = "`sched-sim measure --update"
FORMS = {
    "textbook": f"textbook (Eq. 11); {MEASURE} short` counts a cheaper one, joseph one that bears any gain",
    "joseph": f"joseph, which bears any gain; {MEASURE} short` counts a cheaper one",
    "short": f"short, P - K (P H')', the cheapest; {MEASURE} joseph` counts one that bears any gain",
}

SPARSE = "sparse: costs of filters that leave out zeros and ones of the model"


def update_form(table: CostTable, method: str) -> dict[str, str | None]:
    """For scripts, where `table` says it: the form that its costs of `method` are of, None for methods that keep
    factors of the covariance; and "dense" or "sparse"."""
    form = table.update_form
    said = {} if form is None else {"update_form": form if method in DELAYED_METHODS else None}
    return said | structure_word(table)


def structure_word(table: CostTable) -> dict[str, str | None]:
    """Whether the costs are of a filter that multiplies zeros, "dense", or leaves them out, "sparse"; for scripts and
    for people, where `table` says it."""
    return {} if table.structure is None else {"structure": table.structure}


def update_note(table: CostTable, methods: Iterable[str]) -> str:
    """For people, lines below a table: the form, on a part the ground of its times, and that the machine was busy where
    they were measured; empty where there is nothing to say."""
    named = list(methods)
    about = table.provenance.get("processor")
    ground = (
        ground_note(table, named, {str(about.get("name")): about.get("calibration")}) if isinstance(about, dict) else ""
    )
    return lines(form_note(table, named), ground, busy_note(table.provenance))


def ground_note(table: CostTable, methods: Iterable[str], calibrations: Mapping[str, str | None]) -> str:
    """What verdicts on parts by counts rest on; calibrations: of each part by its name, None if it has none."""
    if table.target is not None:
        return ""
    forms = _forms(table, methods)
    sparse = table.structure == "sparse"
    unknown_form = "sparse counts" if sparse else "operations as counted"
    counts = f"{table.structure} counts, {forms[0]} form" if forms else unknown_form
    known = [f"{text} on {name}" for name, text in calibrations.items() if text]
    measured = f"measured over predicted {', '.join(known) or 'is not known'}"
    return f"{counts}; {_of_sparse(calibrations, measured if known else '') if sparse else measured}"


def calibration_texts(table: CostTable, parts: Iterable[Part]) -> dict[str, str | None]:
    """Of each part by its name, what was measured of such code as the table counts."""
    from sched_sim.processors.part import calibration_for

    known = {part.name: calibration_for(table, part) for part in parts}
    return {name: None if calibration is None else calibration.text for name, calibration in known.items()}


def _of_sparse(calibrations: Mapping[str, str | None], measured: str) -> str:
    """measured: of the parts on which sparse code was timed; empty if it was on none."""
    others = [name for name, text in calibrations.items() if not text]
    if not others:
        return measured
    where = "the others" if measured else ", ".join(others)
    unknown = f"no published timing of sparse code on {where}: the range is not known"
    return f"{measured}; {unknown}" if measured else unknown


def form_note(table: CostTable, methods: Iterable[str]) -> str:
    """For people, a line below a table, of sparse filters and of instructions another; empty where there is nothing to
    say."""
    forms = _forms(table, methods)
    update = f"covariance update: {FORMS.get(forms[0], forms[0])}" if forms else ""
    return lines(update, counted_note(table))


def counted_note(table: CostTable) -> str:
    """That zeros were left out, and that it is instructions; empty for other costs."""
    return lines(SPARSE if table.structure == "sparse" else "", target_note(table))


def _forms(table: CostTable, methods: Iterable[str]) -> list[str]:
    return [form for method in methods if (form := update_form(table, method).get("update_form"))]
