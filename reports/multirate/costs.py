"""What the patent's filter costs in each form of the covariance, by our counts and by the patent's."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from math import ceil
from typing import NamedTuple

from filters.systems.gps import gps
from sched_sim.costs.table import Cost, CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import MultirateCosts
from sched_sim.design.timing import Timing
from sched_sim.processors.part import Part, on_part
from studies.measurement.methods import measure


class Form(NamedTuple):
    """name: as the report writes it; method: its name in `table`, which holds operation counts."""

    name: str
    method: str
    table: CostTable

    @property
    def square_roots(self) -> int:
        """In one cycle of state update, covariance and gain."""
        return sum(counts.get("sqrt", 0) for counts in self.table.operations[self.method].values())


def our_forms() -> dict[str, Form]:
    """8 states, 4 measurements: `filters.systems.gps`, counted in its real code."""
    textbook, short = (
        measure(gps(steps=30), "counted", form, name=f"counted-{form}") for form in ("textbook", "short")
    )
    forms = (
        Form("conventional, textbook", "multirate", textbook),
        Form("conventional, short", "multirate", short),
        Form("U-D", "multirate-ud", textbook),
        Form("square-root", "multirate-square-root", textbook),
    )
    return {form.name: form for form in forms}


def patents_form() -> Form:
    """The patent's own counts, its logic among them."""
    return Form("the patent's counts", "multirate", load_costs("patent-multirate"))


def time_of(form: Form, processor: Part) -> MultirateCosts[Fraction] | None:
    """In seconds; None if the processor has no time for its square roots."""
    if form.square_roots and "sqrt" not in processor.seconds:
        return None
    costs = select(on_part(form.table, processor), form.method, Options())
    assert isinstance(costs, MultirateCosts)
    return costs


def least_time_of(form: Form, processor: Part) -> MultirateCosts[Fraction]:
    """In seconds; where the processor has no time for square roots, that of all but these."""
    costs = time_of(form, processor) or time_of(_without_square_roots(form), processor)
    assert costs is not None
    return costs


def every(n: int) -> Timing:
    """A gain every n-th step that has until the next one."""
    return Timing(n, 0, n)


def least_period(costs: MultirateCosts[Fraction], share: Fraction) -> int | None:
    """The least n at which one measurement a second takes no more than this share of the processor, None if none does.

    costs: in seconds.
    """
    left = share - costs.state_update
    return max(ceil(costs.covariance_gain / left), 1) if left > 0 else None


def _without_square_roots(form: Form) -> Form:
    def others(counts: Mapping[str, int]) -> dict[str, int]:
        return {kind: number for kind, number in counts.items() if kind != "sqrt"}

    counts = {kind: others(counts) for kind, counts in form.table.operations[form.method].items()}
    costs = {kind: Cost.of(Fraction(sum(each.values()))) for kind, each in counts.items()}
    return form._replace(
        table=replace(form.table, operations={form.method: counts}, costs={form.method: costs}),
    )
