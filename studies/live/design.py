"""What is run: a design, at a speed, in periods of a length."""

from __future__ import annotations

from fractions import Fraction
from math import ceil, floor, log10
from typing import NamedTuple

from sched_sim.bounds import MOST_STEPS
from sched_sim.design.least_speed import achieved_l, least_speed
from sched_sim.design.load import loads
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, DualRateCosts
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option

KINDS = ("hr_restart", "hr_propagate", "hr_update", "lr_propagate", "lr_update")
"""Jobs of the two tasks, as live.c orders them."""
MOST_LOAD = Fraction(95, 100)
"""Share of a core that the kernel leaves to real-time threads (sched_rt_runtime_us)."""
LONGEST_S = 3600
"""Of a run."""


class Design(NamedTuple):
    """costs: of the dual rate filter, in any unit; speed: units per HR period; cycles: those that are compared.

    The first cycle of a run, which has no LR propagate, is not among them."""

    costs: DualRateCosts[Fraction]
    N: int
    M: int
    speed: Fraction
    period_ns: int
    cycles: int

    @property
    def timing(self) -> Timing:
        """With the latest L that the tasks can have."""
        return Timing(self.N, self.M, self.N)

    @property
    def cycle_ns(self) -> int:
        return self.N * self.period_ns

    @property
    def steps(self) -> int:
        """Of all cycles, and of the one before."""
        return (self.cycles + 1) * self.N

    @property
    def load(self) -> Fraction:
        """The share of the core that both tasks take."""
        return sum(loads(self.costs, self.timing, self.speed, Options()), Fraction(0))

    @property
    def predicted(self) -> int | None:
        """The achieved l in steps after k; None where a deadline is missed."""
        return achieved_l(self.costs, self.timing, self.speed)

    @property
    def job_ns(self) -> dict[str, int]:
        """CPU time of each job, in the order of KINDS."""
        works = (self.costs.hr_restart, self.costs.hr, self.costs.hr_update, self.costs.lr_propagate)
        units = zip(KINDS, (*works, self.costs.lr_update), strict=True)
        return {kind: round(self.period_ns * work / self.speed) for kind, work in units}


def check_design(design: Design) -> int:
    """The predicted l. Raises InputError for a design that cannot run in real time: a load that the kernel would
    throttle, deadlines that are missed anyway, a run of hours."""
    speed = f"{option('speed')} {float(design.speed):.6g}"
    if design.load > MOST_LOAD:
        raise InputError(
            f"{speed}: both tasks take {float(100 * design.load):.4g} % of the core, and the kernel gives real-time "
            f"threads no more than {float(100 * MOST_LOAD):g} %: give at least {_least(design)}"
        )
    predicted = design.predicted
    if predicted is None:
        raise InputError(
            f"{speed}: corrections are predicted to land after the next measurement, or an HR job to overrun its "
            f"period, and the tasks have one measurement on its way: give at least {_least(design)}"
        )
    seconds = design.steps * design.period_ns / 1e9
    if design.steps > MOST_STEPS or seconds > LONGEST_S:
        raise InputError(
            f"{option('cycles')} {design.cycles} of {option('N')} {design.N} take {seconds:.0f} s: give fewer, for at "
            f"most {LONGEST_S} s and {MOST_STEPS:,} steps"
        )
    return predicted


def _least(design: Design) -> str:
    """The least speed that is not refused."""
    deadlines = least_speed(design.costs, design.timing).speed
    return rounded_up(max(deadlines, design.speed * design.load / MOST_LOAD), 4)


def rounded_up(value: Fraction | float, digits: int) -> str:
    """In so many digits, never less than the value."""
    exponent = floor(log10(value)) - digits + 1
    unit = Fraction(10) ** exponent
    return f"{float(ceil(Fraction(value) / unit) * unit):.{digits}g}"


def of_dual_rate(costs: Costs) -> DualRateCosts[Fraction]:
    """Costs that `select` gave for the dual rate filter."""
    assert isinstance(costs, DualRateCosts)
    return costs
