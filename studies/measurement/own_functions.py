"""How much of each job is spent in the functions of the system: f, F, Q, h, H and R.

Each job is timed a second time, in the same rounds, with functions that only hand out what those gave at one state: the
rest is theirs. Timed alone they would seem cheaper than they are, for one that asks for memory hampers the compiler in
all of the job that it is merged into. They are timed alone too, to say which of them it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.backends.allocations import allocations
from filters.backends.bind import like
from filters.jobs import Job
from filters.samples import sample
from filters.system import System
from sched_sim.costs.table import CostTable

OWN, WITHOUT = "own functions", "without own functions:"
"""They stand where a job has its method: the functions alone, and the methods without them."""

Jobs = Mapping[tuple[str, str], Job]


class OwnFunction(NamedTuple):
    """seconds: of a call. allocations: new arrays and lists that it makes."""

    seconds: float
    allocations: int


class Kept(NamedTuple):
    """What the functions of a system gave at one state: x (n,) and z (p,) of f and h, and the matrices."""

    x: FloatArray
    F: FloatArray
    Q: FloatArray
    z: FloatArray
    H: FloatArray
    R: FloatArray


def with_own(jobs: Jobs, system: System, seed: int, x0: FloatArray | None) -> dict[tuple[str, str], Job]:
    """These jobs, the same without the functions of their system, and these alone; for `with_shares`."""

    def alone(index: int) -> tuple[Any, ...]:
        at = sample(system, seed, index, x0)
        return system, at.m, at.now.x, at.u, np.zeros(max(system.states, system.measurements))

    constant = _constant(*alone(0))
    return {
        **jobs,
        **{
            (f"{WITHOUT} {method}", kind): job._replace(arguments=partial(_arguments, job, constant))
            for (method, kind), job in jobs.items()
        },
        **{(OWN, name): Job(name, function, alone) for name, function in _ALONE.items()},
    }


def with_shares(table: CostTable, jobs: Jobs) -> CostTable:
    """The table of the jobs of `with_own`, of which only the first are costs; its provenance has of the others, under
    `own_share`, what share of each job's time is spent in the functions, and under `own_functions` what each takes."""
    kept = {method for method in table.costs if method != OWN and not method.startswith(WITHOUT)}
    shares = {
        method: {
            kind: max(0.0, round(float(1 - table.entry(f"{WITHOUT} {method}", kind).minimum / cost.minimum), 3))
            for kind, cost in table.costs[method].items()
        }
        for method in table.costs
        if method in kept
    }
    functions = {
        name: OwnFunction(float(cost.minimum), allocations(job.function, job.arguments(0)))._asdict()
        for name, cost in table.costs[OWN].items()
        for job in [jobs[OWN, name]]
    }
    return replace(
        table,
        costs={method: kinds for method, kinds in table.costs.items() if method in kept},
        provenance={**table.provenance, "own_functions": functions, "own_share": shares},
    )


def _arguments(job: Job, constant: System, index: int) -> tuple[Any, ...]:
    replaced: tuple[Any, ...] = _replaced(job.arguments(index), constant)
    return replaced


def _replaced(value: Any, constant: System) -> Any:
    """The value with `constant` in place of each system in it."""
    if isinstance(value, System):
        return constant
    if isinstance(value, tuple):
        return like(value, [_replaced(item, constant) for item in value])
    return value


def _constant(system: System, j: int, x: FloatArray, u: FloatArray, _out: FloatArray) -> System:
    """A system of the same size whose functions hand out what those of this one give now."""
    parameters, x_next, z = system.parameters, np.zeros(system.states), np.zeros(system.measurements)
    system.f(j, x, u, parameters, x_next)
    system.h(j, x, parameters, z)
    F, H = system.F(j, x, u, parameters), system.H(j, x, parameters)
    matrices = [
        np.array(matrix, dtype=np.float64) for matrix in (F, system.Q(j, parameters), H, system.R(j, parameters))
    ]
    kept = Kept(x_next, matrices[0], matrices[1], z, matrices[2], matrices[3])
    return System(*system[:3], _kept_f, _kept_F, _kept_Q, _kept_h, _kept_H, _kept_R, kept)


def _kept_f(_j: int, _x: FloatArray, _u: FloatArray, kept: Kept, out: FloatArray) -> None:
    for i in range(len(kept.x)):
        out[i] = kept.x[i]


def _kept_F(_j: int, _x: FloatArray, _u: FloatArray, kept: Kept) -> FloatArray:
    return kept.F


def _kept_Q(_j: int, kept: Kept) -> FloatArray:
    return kept.Q


def _kept_h(_k: int, _x: FloatArray, kept: Kept, out: FloatArray) -> None:
    for i in range(len(kept.z)):
        out[i] = kept.z[i]


def _kept_H(_k: int, _x: FloatArray, kept: Kept) -> FloatArray:
    return kept.H


def _kept_R(_k: int, kept: Kept) -> FloatArray:
    return kept.R


def _f(system: System, j: int, x: FloatArray, u: FloatArray, out: FloatArray) -> None:
    system.f(j, x, u, system.parameters, out[: system.states])


def _F(system: System, j: int, x: FloatArray, u: FloatArray, out: FloatArray) -> None:
    out[0] = system.F(j, x, u, system.parameters)[0, 0]


def _Q(system: System, j: int, _x: FloatArray, _u: FloatArray, out: FloatArray) -> None:
    out[0] = system.Q(j, system.parameters)[0, 0]


def _h(system: System, k: int, x: FloatArray, _u: FloatArray, out: FloatArray) -> None:
    system.h(k, x, system.parameters, out[: system.measurements])


def _H(system: System, k: int, x: FloatArray, _u: FloatArray, out: FloatArray) -> None:
    out[0] = system.H(k, x, system.parameters)[0, 0]


def _R(system: System, k: int, _x: FloatArray, _u: FloatArray, out: FloatArray) -> None:
    out[0] = system.R(k, system.parameters)[0, 0]


_ALONE: Mapping[str, Callable[..., None]] = {"f": _f, "F": _F, "Q": _Q, "h": _h, "H": _H, "R": _R}
