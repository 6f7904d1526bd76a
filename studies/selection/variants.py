"""Every way to run a method that is looked at, as a design of its own."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from filters.delayed.low_rate_noise import LowRateNoise
from sched_sim.costs.table import CostTable
from sched_sim.design.methods import METHODS as SCHEDULED
from sched_sim.design.options import Gain, Options
from studies.selection.methods import METHODS

NOISES: tuple[LowRateNoise, ...] = ("exact", "sum", "euler")
GAINS: tuple[Gain, ...] = ("at-update", "precomputed")


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

    def _choices(self) -> list[str]:
        choices = []
        if self.options.low_rate_noise != "exact":
            choices.append({"sum": "Q' (Eq. 23)", "euler": "Q'' (Eq. 24)"}[self.options.low_rate_noise])
        if self.options.gain == "precomputed":
            choices.append("gain early")
        if self.table.update_form not in (None, "textbook"):
            choices.append(f"{self.table.update_form} update")
        return choices


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
    noises: Sequence[LowRateNoise] = NOISES,
    gains: Sequence[Gain] = GAINS,
) -> Iterator[Variant]:
    """noises, gains: those of the dual-rate filter that are looked at; the others have `options` alone."""
    for method in methods:
        for number in every:
            for table in tables:
                if method not in table.costs:
                    continue
                if method != "dual-rate":
                    yield Variant(method, number, table, replace(options, low_rate_noise="exact", gain="at-update"))
                    continue
                for noise in noises:
                    for gain in gains:
                        if _has(table, noise, gain):
                            yield Variant(method, number, table, replace(options, low_rate_noise=noise, gain=gain))


def _has(table: CostTable, noise: LowRateNoise, gain: Gain) -> bool:
    kinds = table.costs["dual-rate"]
    high = "hr_propagate" if noise == "exact" else f"hr_propagate_{noise}"
    low = "lr_propagate_euler" if noise == "euler" else "lr_propagate"
    late = ("lr_gain", "lr_correct") if gain == "precomputed" else ("lr_update",)
    return all(kind in kinds for kind in (high, low, *late))
