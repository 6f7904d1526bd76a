"""What each part of a composed filter takes: many executions, each timed by itself and kept in its order."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Literal, TypeAlias, get_args

import numpy as np

from filters.backends.allocations import allocations
from filters.backends.timed import Clock
from filters.choice import check_choice
from filters.kernels.place import IntArray
from filters.seed import check_seed
from sched_sim.costs.autocorrelation import rank_autocorrelation
from sched_sim.costs.sample_file import SampledCosts
from sched_sim.errors import InputError
from studies.measurement.busy import clocks, load, signs_of_others
from studies.measurement.clock import described, monotonic, switches
from studies.measurement.executions import FLUSHED, Course, Executions, Wanted, alone, in_order, run
from studies.measurement.job_times import Progress, check_compiles, silent
from studies.measurement.loop_order import loops_of, order_of
from studies.measurement.methods import COUNTED_SOURCE, counted, nonzero, where_timed
from studies.measurement.user_filter import UserFilter

Backend: TypeAlias = Literal["compiled", "counted"]
Caches: TypeAlias = Literal["warm", "cold", "sequence"]
"""Before each execution: the same job has just run; other work has; the filter's loop has, part by part."""

QUICK = Wanted(executions=100_000, seconds=5.0)
THOROUGH = Wanted(executions=1_000_000, seconds=50.0)
BEFORE = {
    "warm": "the same part has just run before each execution: caches are warm",
    "cold": f"{FLUSHED >> 20} MB were written to before each execution: what caches larger than that hold stays there, "
    "and so does what predicts branches",
    "sequence": "parts run in the order in which the filter's loop runs them, a sensor's when its measurement is due",
}
MOST_TOGETHER = 8_000_000
"""Samples in one file."""
STEPS_IN_ORDER = 100_000
"""Of a loop, before it begins again with a measurement of each sensor."""


def measure_filter(
    user: UserFilter,
    backend: Backend = "compiled",
    *,
    name: str,
    caches: Caches = "warm",
    thorough: bool = False,
    seed: int = 0,
    progress: Progress = silent,
) -> SampledCosts:
    """The costs of the filter's parts. compiled: samples in ns, each one execution, with `caches` as they are before
    it; their rank autocorrelation, and under `allocations` the new arrays that each part makes, all of them in the
    user's functions, in the provenance. counted: exact operations, one sample of each.

    Raises InputError for another backend, caches or seed, and for a part that numba cannot compile, or that cannot be
    counted.
    """
    try:
        check_choice("backend", backend, get_args(Backend))
        check_choice("caches", caches, get_args(Caches))
        check_seed(seed)
    except ValueError as error:
        raise InputError(str(error)) from None
    if backend == "compiled":
        return _timed(user, name, caches, THOROUGH if thorough else QUICK, seed, progress)
    operations = counted(user.jobs, progress)
    samples = {part: (Fraction(tally.total),) for part, tally in operations.items()}
    counts = {part: nonzero(tally) for part, tally in operations.items()}
    return SampledCosts(name, "operation", samples, counts, _about(user, backend) | {"source": COUNTED_SOURCE})


def _timed(user: UserFilter, name: str, caches: Caches, most: Wanted, seed: int, progress: Progress) -> SampledCosts:
    check_compiles()
    wanted = Wanted(min(most.executions, MOST_TOGETHER // len(user.jobs)), most.seconds)
    before, clock = load(), monotonic()
    found = run(_courses(user, caches, wanted, clock, seed, progress), wanted, seed, progress)
    spans = {part: np.maximum(found.ns[part], 1) for part in user.jobs}  # 0: less than the clock's resolution
    alike = [_some(each) for each in spans.values()] if caches == "warm" else []
    busy = signs_of_others(before, found.began, clocks(), alike)
    about_clock = described(clock)
    about = {
        "source": (
            f"{BEFORE[caches]}; each sample is one execution, timed by itself in compiled code, in their order; in it "
            f"are two readings of the clock, {about_clock['median_ns']} ns with nothing between them, interrupts, and "
            f"what a hypervisor took; {_others(found)}"
        ),
        "executions": True,
        "caches": caches,
        **where_timed(wanted, seed, busy),
        "clock": about_clock,
        "autocorrelation": {part: round(rank_autocorrelation(each), 4) for part, each in spans.items()},
        "allocations": {part: allocations(job.function, job.arguments(0)) for part, job in user.jobs.items()},
    }
    samples = {part: _exact(each) for part, each in spans.items()}
    return SampledCosts(name, "ns", samples, {}, _about(user, "compiled") | about)


def _others(found: Executions) -> str:
    """What else the operating system ran meanwhile."""
    if switches() is None:
        return "and what else the operating system ran, which it does not tell"
    never = f", {found.disturbed} never without" if found.disturbed else ""
    timed = f"{found.again} of {found.blocks + found.again}{never}"
    return f"blocks in which the operating system ran something else were timed again: {timed}"


def _courses(
    user: UserFilter, caches: Caches, wanted: Wanted, clock: Clock, seed: int, progress: Progress
) -> list[Course]:
    courses, random = [], np.random.default_rng(seed)
    loops = loops_of(user.jobs) if caches == "sequence" else [[part] for part in user.jobs]
    for number, loop in enumerate(loops):
        progress(number, len(loops), f"preparing {' '.join(loop)}")
        if caches == "sequence":
            order = order_of(loop, user.composed, STEPS_IN_ORDER)
            courses.append(in_order(loop, [user.jobs[part] for part in loop], order, wanted, clock, random))
        else:
            courses += [alone(part, user.jobs[part], caches, wanted, clock, random) for part in loop]
    return courses


def _exact(spans: IntArray) -> tuple[Fraction, ...]:
    """Equal ones are one object."""
    values, places = np.unique(spans, return_inverse=True)
    fractions = [Fraction(value) for value in values.tolist()]
    return tuple(map(fractions.__getitem__, places.tolist()))


def _some(spans: IntArray) -> list[int]:
    """Enough of them to tell the spread."""
    few: list[int] = spans[:: 1 + len(spans) // 10_000].tolist()
    return few


def _about(user: UserFilter, backend: Backend) -> dict[str, Any]:
    predictor = user.composed.predictor
    kinds = {sensor.name: sensor.corrector.kind for sensor in user.composed.sensors}
    return {
        "backend": backend,
        "predictor": predictor.kind,
        "states": predictor.states,
        "sensors": kinds,
        "update": user.composed.update,
    }
