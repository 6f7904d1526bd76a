"""Memory of a method on a board, by task: what its code takes, what it keeps, and how deep its stack goes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, TypeAlias

import numpy as np

from filters.jobs import Job
from filters.system import System
from filters.translation.library import Precision
from sched_sim.costs.methods import MULTIRATE_METHODS, ROBUST_METHODS
from studies.measurement.emulation.jobs import Emulated, numbers_of, sources
from studies.measurement.emulation.targets import Target
from studies.measurement.emulation.toolchain import code_bytes

LOW_RATE: Mapping[str, tuple[str, ...]] = {
    "dual-rate": ("lr_propagate", "lr_update"),
    "delayed-horizon": ("update", "replay", "propagate_covariance"),
    **dict.fromkeys(MULTIRATE_METHODS, ("covariance_gain",)),
    **dict.fromkeys(ROBUST_METHODS, ("robust_step",)),
}
"""The jobs of the LR task. HR preempts it, so that each task has arrays of its own, also where they pass a message."""

ONLY_IF_ASKED: Mapping[str, tuple[str, ...]] = {
    "larsen": ("gain", "correct", "compensate"),
    "dual-rate": ("hr_propagate_sum", "hr_propagate_euler", "lr_propagate_euler", "lr_gain", "lr_correct"),
    "carried-gain": ("couple", "compensate"),
}
"""Jobs of options, or of several measurements in flight, which are not in the memory."""

WITHIN: Mapping[str, tuple[str, ...]] = {"dual-rate": ("Phi_from_k", "P_next", "P_posterior")}
"""Parameters that are parts of others: of the transition, of the reference, and P of the next cycle."""

Memory: TypeAlias = dict[str, dict[str, int]]
"""By task, and of the model: code (with constants), ram and stack, in bytes."""

COUNTED = (
    "bytes; code: without the C library; ram: each argument of the task's jobs once; stack: without interrupts; not in "
    "it: inputs and measurements that wait; model: its parameters, ram if they are named scratch"
)


def memory_of(
    method: str, jobs: Mapping[str, Job], found: Mapping[str, Emulated], target: Target, precision: Precision
) -> Memory:
    """Of a method's jobs by kind, and what was measured of them.

    Raises:
        Untranslatable: see `jobs.sources`.
    """
    wanted = [kind for kind in jobs if kind not in ONLY_IF_ASKED.get(method, ())]
    low = [kind for kind in wanted if kind in LOW_RATE.get(method, ())]
    tasks = {"HR": [kind for kind in wanted if kind not in low], **({"LR": low} if low else {})}
    memory = {
        task: {
            "code": _code({kind: jobs[kind] for kind in kinds}, target, precision),
            "ram": _ram(method, [jobs[kind] for kind in kinds], precision),
            "stack": max(found[kind].stack for kind in kinds),
        }
        for task, kinds in tasks.items()
    }
    systems = [value for job in jobs.values() for value in job.arguments(0) if isinstance(value, System)]
    return memory | ({"model": _model(systems[0].parameters, precision)} if systems else {})


def _code(jobs: Mapping[str, Job], target: Target, precision: Precision) -> int:
    _, files = sources(jobs, precision)
    return code_bytes(target, files)


def _ram(method: str, jobs: Iterable[Job], precision: Precision) -> int:
    sizes: dict[str, int] = {}
    for job in jobs:
        names = job.function.__code__.co_varnames
        for name, value in zip(names, job.arguments(0), strict=False):
            if isinstance(value, System) or name.startswith("_") or name in WITHIN.get(method, ()):
                continue
            sizes[name] = max(sizes.get(name, 0), _bytes(value, precision))
    return sum(sizes.values())


def _model(parameters: Any, precision: Precision) -> dict[str, int]:
    """Constants lie beside the code; scratch is written."""
    scratch = _bytes(getattr(parameters, "scratch", ()), precision)
    return {"code": _bytes(parameters, precision) - scratch, "ram": scratch, "stack": 0}


def _bytes(value: Any, precision: Precision) -> int:
    real = 4 if precision == "single" else 8
    arrays = [each for each in numbers_of(value) if isinstance(each, np.ndarray)]
    return sum(array.size * (real if array.dtype.kind == "f" else array.itemsize) for array in arrays)
