"""Which covariance update the costs are of: it matters as much as the method."""

from __future__ import annotations

from collections.abc import Iterable

from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.costs.table import CostTable

MEASURE = "`sched-sim measure --update"
FORMS = {
    "textbook": f"textbook (Eq. 11); {MEASURE} short` counts a cheaper one, joseph one that bears any gain",
    "joseph": f"joseph, which bears any gain; {MEASURE} short` counts a cheaper one",
    "short": f"short, P - K (P H')', the cheapest; {MEASURE} joseph` counts one that bears any gain",
}


def update_form(table: CostTable, method: str) -> dict[str, str | None]:
    """For scripts, where `table` says it: the form that its costs of `method` are of; None for methods that keep
    factors of the covariance."""
    form = table.update_form
    return {} if form is None else {"update_form": form if method in DELAYED_METHODS else None}


def update_note(table: CostTable, methods: Iterable[str]) -> str:
    """For people, a line below a table; empty where there is nothing to say."""
    forms = [form for method in methods if (form := update_form(table, method).get("update_form"))]
    return f"covariance update: {FORMS.get(forms[0], forms[0])}" if forms else ""
