"""What the costs are of: which covariance update, which matters as much as the method, and whether zeros are
multiplied."""

from __future__ import annotations

from collections.abc import Iterable

from sched_sim.cli.instructions import target_note
from sched_sim.cli.output import lines
from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.costs.table import CostTable, busy_note
from sched_sim.processors.ground import ground, update_forms

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
    calibration = {str(about.get("name")): about.get("calibration")} if isinstance(about, dict) else None
    return lines(
        form_note(table, named),
        "" if calibration is None else ground(table, named, calibration),
        busy_note(table.provenance),
    )


def form_note(table: CostTable, methods: Iterable[str]) -> str:
    """For people, a line below a table, of sparse filters and of instructions another; empty where there is nothing to
    say."""
    forms = update_forms(table, methods)
    update = f"covariance update: {FORMS.get(forms[0], forms[0])}" if forms else ""
    return lines(update, counted_note(table))


def counted_note(table: CostTable) -> str:
    """That zeros were left out, and that it is instructions; empty for other costs."""
    return lines(SPARSE if table.structure == "sparse" else "", target_note(table))
