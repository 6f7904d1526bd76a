"""What each part of a composed filter takes, one figure for each of many samples.

Not yet the distribution of one execution: a call of the loop takes longer than the jobs in it, and its least time is
what is subtracted. So the samples rank parts, and carry no probability of a rare event.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any, Literal, TypeAlias, get_args

from filters.backends.allocations import allocations
from filters.choice import check_choice
from filters.seed import check_seed
from sched_sim.costs.sample_file import SampledCosts
from sched_sim.errors import InputError
from studies.measurement.job_times import Progress, Protocol, silent, time_jobs
from studies.measurement.methods import COUNTED_SOURCE, counted, nonzero, where_timed
from studies.measurement.user_filter import UserFilter

Backend: TypeAlias = Literal["compiled", "counted"]

QUICK = Protocol(rounds=1000, repetitions=20)
THOROUGH = Protocol(rounds=10_000, repetitions=20)
"""Few repetitions, so that what slows one of them (a cold cache, another clock rate) is seen in its sample."""


def measure_filter(
    user: UserFilter,
    backend: Backend = "compiled",
    *,
    name: str,
    thorough: bool = False,
    seed: int = 0,
    progress: Progress = silent,
) -> SampledCosts:
    """The costs of the filter's parts. compiled: samples in seconds, and under `allocations` in the provenance the new
    arrays that each part makes, all of them in the user's functions; counted: exact operations, one sample of each.

    Raises InputError for another backend or seed, and for a part that numba cannot compile, or that cannot be counted.
    """
    try:
        check_choice("backend", backend, get_args(Backend))
        check_seed(seed)
    except ValueError as error:
        raise InputError(str(error)) from None
    if backend == "compiled":
        costs = timed_together({name: user}, thorough=thorough, seed=seed, progress=progress)[name]
        new = {part: allocations(job.function, job.arguments(0)) for part, job in user.jobs.items()}
        return replace(costs, provenance={**costs.provenance, "allocations": new})
    operations = counted(user.jobs, progress)
    samples = {part: (Fraction(tally.total),) for part, tally in operations.items()}
    counts = {part: nonzero(tally) for part, tally in operations.items()}
    return SampledCosts(name, "operation", samples, counts, _about(user, backend) | {"source": COUNTED_SOURCE})


def timed_together(
    users: Mapping[str, UserFilter], *, thorough: bool = False, seed: int = 0, progress: Progress = silent
) -> dict[str, SampledCosts]:
    """Samples of several filters' parts, by name, timed in the same rounds: what disturbs one disturbs all.

    Raises InputError for a part that numba cannot compile.
    """
    protocol = THOROUGH if thorough else QUICK
    jobs = {(name, part): job for name, user in users.items() for part, job in user.jobs.items()}
    timed = time_jobs(jobs, "compiled", protocol, seed, progress)
    source = (
        f"{protocol.rounds} samples of each part; a sample is the mean of {protocol.repetitions} executions in one "
        "compiled call, less the least time of an empty loop, so that most of it is the loop's; other parts run in "
        "between; time in which the operating system runs something else is not counted"
    )
    return {
        name: SampledCosts(
            name,
            "second",
            {part: tuple(Fraction(f"{each:.4g}") for each in timed.seconds[name, part]) for part in user.jobs},
            {},
            _about(user, "compiled") | {"source": source, **where_timed(protocol, seed, timed.busy)},
        )
        for name, user in users.items()
    }


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
