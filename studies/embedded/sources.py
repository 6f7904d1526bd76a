"""The sources of costs that stand side by side, each with a cost table of the same jobs."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import NamedTuple

from filters.covariance_forms import CovarianceFormName
from filters.systems.example import example_system
from sched_sim.costs.methods import DelayedMethod
from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import least_speed
from sched_sim.design.method import CostOf
from sched_sim.design.methods import select
from sched_sim.design.pieces import Statistic
from sched_sim.design.timing import Timing
from studies.measurement.emulation.targets import TARGETS
from studies.measurement.job_times import Progress, silent
from studies.measurement.methods import BackendName, measure
from studies.steffes.tables import cases

SIZES = (9, 3, 3)
"""States, inputs, measurements."""
FORMS: tuple[CovarianceFormName, ...] = ("textbook", "short")
METHODS: tuple[DelayedMethod, ...] = (
    "standard",
    "recalculate",
    "larsen",
    "dual-rate",
    "clone",
    "clone-split",
    "carried-gain",
    "delayed-horizon",
)
SHIPPED: Mapping[CovarianceFormName, str] = {"textbook": "counted-9-3-3", "short": "counted-9-3-3-short"}
"""The tables of counted operations."""
FIRST = Timing(10, 4, 8)
DESIGNS = (*cases(), Timing(80, 44, 60))
"""Those of Steffes 2014, Table 4, of which `FIRST` is one, and GPS at 5 Hz, 110 ms late, in a loop at 400 Hz."""


class Source(NamedTuple):
    """name: of its table, with the form. target: of an emulated core."""

    name: str
    backend: BackendName
    target: str | None = None


EMULATED = tuple(Source(name, "emulated", name) for name in TARGETS)
NATIVE = (Source("c", "c"), Source("numba", "compiled"), Source("numpy", "numpy"))


def table_of(
    source: Source, form: CovarianceFormName, *, thorough: bool = False, progress: Progress = silent
) -> CostTable:
    """What the source says of the jobs of `METHODS`.

    Raises InputError where a compiler or the emulator is missing.
    """
    return measure(
        example_system(*SIZES),
        source.backend,
        form,
        name=f"{source.name}-{form}",
        thorough=thorough,
        progress=progress,
        methods=METHODS,
        target=source.target,
    )


def counted(form: CovarianceFormName) -> CostTable:
    """Operations of the same jobs, as the table that ships has them."""
    return load_costs(SHIPPED[form])


def relative_speed(table: CostTable, method: str, timing: Timing, statistic: Statistic = "median") -> Fraction:
    """The least speed of a method over that of the standard filter: propagate + update, by the same statistic."""
    costs = [CostOf(table, "standard", statistic)(kind) for kind in ("propagate", "update")]
    unit = sum(costs, start=Fraction(0))
    return least_speed(select(table, method, statistic=statistic), timing).speed / unit
