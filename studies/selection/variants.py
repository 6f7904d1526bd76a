"""Every way to run a method that is looked at, as a design of its own."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any, NamedTuple, TypeAlias

from sched_sim.costs.table import CostTable
from sched_sim.design.methods import METHODS as SCHEDULED
from sched_sim.design.options import Options, choices
from studies.selection.methods import METHODS

Ways: TypeAlias = Mapping[str, tuple[Any, ...]]
"""Choices of the dual-rate filter that are looked at, by the names of `Options`."""

WAYS: Ways = {name: choices()[name] for name in ("low_rate_noise", "gain", "lr_propagate_by", "feedback")}
"""All."""


class Variant(NamedTuple):
    """A method with every so manieth measurement, with costs and choices."""

    method: str
    every: int
    table: CostTable
    options: Options

    @property
    def how(self) -> str:
        """What is not as in the paper, in words; empty if nothing."""
        return ", ".join(self._choices())

    @property
    def departures(self) -> int:
        """So many choices are not as in the paper."""
        return len(self._choices())

    def is_beside(self, options: Options) -> bool:
        """Whether it is another way to schedule the dual-rate filter than that of the options."""
        return self.method == "dual-rate" and any(
            getattr(self.options, name) != getattr(options, name) for name in ("lr_propagate_by", "feedback")
        )

    def _choices(self) -> list[str]:
        choices = _of_dual_rate(self.options) if self.method == "dual-rate" else []
        if self.table.update_form not in (None, "textbook"):
            choices.append(f"{self.table.update_form} update")
        return choices


def _of_dual_rate(options: Options) -> list[str]:
    words = {
        "Q' (Eq. 23)": options.low_rate_noise == "sum",
        "Q'' (Eq. 24)": options.low_rate_noise == "euler",
        "gain early": options.gain == "precomputed",
        "propagate by l": options.lr_propagate_by == "l",
        "same step": options.feedback == "same-step",
    }
    return [said for said, chosen in words.items() if chosen]


def candidates(methods: Sequence[str] | None, tables: Sequence[CostTable], M: int) -> list[str]:
    """Methods that have an accuracy, a schedule and costs; by default without those for which nothing is late."""
    known = [name for name in METHODS if name in SCHEDULED and any(name in table.costs for table in tables)]
    if methods:
        return [name for name in known if name in methods]
    return [name for name in known if name != "standard" or M == 0]


def variants(
    methods: Sequence[str],
    every: Sequence[int],
    tables: Sequence[CostTable],
    options: Options,
    ways: Ways = WAYS,
) -> Iterator[Variant]:
    """ways: those of the dual-rate filter; the other methods have none of these choices, and `options` alone."""
    for method in methods:
        for number in every:
            for table in tables:
                if method not in table.costs:
                    continue
                if method != "dual-rate":
                    yield Variant(method, number, table, replace(options, low_rate_noise="exact", gain="at-update"))
                    continue
                for chosen in product(*ways.values()):
                    way = replace(options, **dict(zip(ways, chosen, strict=True)))
                    if _has(table, way):
                        yield Variant(method, number, table, way)


def kept(options: Options) -> Ways:
    """What differs from the paper's is kept to."""
    paper = Options()
    return {
        name: known if getattr(options, name) == getattr(paper, name) else (getattr(options, name),)
        for name, known in WAYS.items()
    }


def _has(table: CostTable, options: Options) -> bool:
    kinds, noise = table.costs["dual-rate"], options.low_rate_noise
    high = "hr_propagate" if noise == "exact" else f"hr_propagate_{noise}"
    low = "lr_propagate_euler" if noise == "euler" else "lr_propagate"
    late = ("lr_gain", "lr_correct") if options.gain == "precomputed" else ("lr_update",)
    return all(kind in kinds for kind in (high, low, *late))
