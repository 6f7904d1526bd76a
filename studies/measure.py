"""What each job of each filter costs, from its real code: counted, compiled or as NumPy calls.

Protocol of the timed backends: each job runs `repetitions` times inside one call, on arguments that rotate from call
to call; jobs are shuffled in each of `rounds` rounds, garbage collection is off, and the least time of a loop that
does nothing with the same arguments is subtracted (passing them costs as much as the smallest jobs). A round gives one
figure per job: its mean time. Minimum, median and 95th percentile are over rounds.
"""

from __future__ import annotations

import gc
import platform
import random
import statistics
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from fractions import Fraction
from importlib.metadata import version
from time import perf_counter_ns
from typing import Any, Literal, NamedTuple, TypeVar

from filters.covariance_forms import CovarianceFormName
from filters.kernels.backends import arguments_for, function_for
from filters.kernels.counted import Operations, count
from filters.kernels.repeat import repeat
from filters.registry import ALL_METHODS, Job
from filters.systems.system import System
from sched_sim.costs import Cost, CostTable

BackendName = Literal["compiled", "counted", "numpy"]

ARGUMENT_SETS = 8

Progress = Callable[[int, int, str], None]
"""Called with (done, total, what)."""


class Protocol(NamedTuple):
    """How often a job is timed; see the module."""

    rounds: int
    repetitions: int


QUICK = Protocol(rounds=61, repetitions=1000)
THOROUGH = Protocol(rounds=601, repetitions=1000)
QUICK_NUMPY = Protocol(rounds=61, repetitions=10)
THOROUGH_NUMPY = Protocol(rounds=201, repetitions=30)


def silent(_done: int, _total: int, _what: str) -> None:
    """No progress shown."""


def measure(
    system: System,
    backend: BackendName = "compiled",
    update: CovarianceFormName = "textbook",
    *,
    name: str,
    thorough: bool = False,
    x0: Any = None,
    seed: int = 0,
    progress: Progress = silent,
    methods: Sequence[str] = tuple(ALL_METHODS),
) -> CostTable:
    """The cost table of these methods on one system.

    unit: "operation" (each multiply, add, divide, square root counts one) for counted, else "second".
    update: the covariance form, of no use to methods that keep factors of the covariance.
    x0 (n,): a typical state of the system, zero if not given.
    """
    jobs = {
        (method, kind): job
        for method in methods
        for kind, job in ALL_METHODS[method].jobs(system, update, seed, x0).items()
    }
    about = {
        "update_form": update,
        "states": system.states,
        "inputs": system.inputs,
        "measurements": system.measurements,
    }
    return cost_table(jobs, backend, about, name=name, thorough=thorough, seed=seed, progress=progress)


def cost_table(
    jobs: Mapping[tuple[str, str], Job],
    backend: BackendName,
    about: Mapping[str, Any],
    *,
    name: str,
    thorough: bool = False,
    seed: int = 0,
    progress: Progress = silent,
) -> CostTable:
    """The cost table of these jobs, by method and kind; about: what else is to be said of them."""
    about = {"backend": backend, **about}
    if backend == "counted":
        operations = {key: count(job.function, *job.arguments(0)) for key, job in jobs.items()}
        about["source"] = "exact operation counts: multiply, add, divide and square root count one each"
        costs = {key: Cost.of(Fraction(found.total)) for key, found in operations.items()}
        counts = {key: _nonzero(found) for key, found in operations.items()}
        return CostTable(name, "operation", _by_method(costs), about, operations=_by_method(counts))
    protocol = _protocol(backend, thorough)
    times = _time(jobs, backend, protocol, seed, progress)
    about |= {
        "source": "means over the repetitions of a round; minimum, median and 95th percentile over rounds",
        "machine": machine(),
        "date": datetime.now(UTC).date().isoformat(),
        "versions": versions(),
        "protocol": {**protocol._asdict(), "argument_sets": ARGUMENT_SETS, "seed": seed},
    }
    return CostTable(name, "second", _by_method({key: _cost(found) for key, found in times.items()}), about)


def machine() -> str:
    """The processor's name, as well as the system tells it."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            for line in file:
                if line.startswith("model name"):
                    return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def versions() -> dict[str, str]:
    return {"python": platform.python_version(), **{name: version(name) for name in ("numpy", "numba")}}


def _protocol(backend: BackendName, thorough: bool) -> Protocol:
    if backend == "numpy":
        return THOROUGH_NUMPY if thorough else QUICK_NUMPY
    return THOROUGH if thorough else QUICK


def _time(
    jobs: Mapping[tuple[str, str], Job],
    backend: Literal["compiled", "numpy"],
    protocol: Protocol,
    seed: int,
    progress: Progress,
) -> dict[tuple[str, str], list[float]]:
    """Seconds per run of each job, one figure a round."""
    total = len(jobs) + protocol.rounds
    runs, empty_runs = {}, {}
    for done, (key, job) in enumerate(jobs.items()):
        progress(done, total, f"preparing {key[0]} {key[1]}")
        runs[key] = _timer(job.function, job.arguments, backend, protocol.repetitions)
        empty_runs[key] = _timer(_nothing, job.arguments, backend, protocol.repetitions)
    found: dict[tuple[str, str], list[int]] = {key: [] for key in jobs}
    overhead: dict[tuple[str, str], list[int]] = {key: [] for key in jobs}
    order, shuffle = list(jobs), random.Random(seed)
    with _no_garbage_collection():
        for round_number in range(protocol.rounds):
            progress(len(jobs) + round_number, total, "timing")
            shuffle.shuffle(order)
            for key in order:
                found[key].append(runs[key](round_number))
                overhead[key].append(empty_runs[key](round_number))
    progress(total, total, "timed")
    scale = protocol.repetitions * 1e9
    return {key: [max(each - min(overhead[key]), 1) / scale for each in found[key]] for key in jobs}


def _timer(
    function: Callable[..., Any],
    arguments: Callable[[int], tuple[Any, ...]],
    backend: Literal["compiled", "numpy"],
    repetitions: int,
) -> Callable[[int], int]:
    """A function that runs the job and says how many nanoseconds all repetitions took; compiled and warm."""
    sets = [arguments_for(backend, arguments(index)) for index in range(ARGUMENT_SETS)]
    if backend == "compiled":
        loop, job = function_for(backend, repeat), arguments_for(backend, function)
    else:
        loop, job = repeat, function_for(backend, function)

    def run(number: int) -> int:
        chosen = sets[number % ARGUMENT_SETS]
        start = perf_counter_ns()
        loop(job, chosen, repetitions)
        return perf_counter_ns() - start

    for number in range(ARGUMENT_SETS):
        run(number)
    return run


def _nothing(*_arguments: Any) -> None:
    pass


@contextmanager
def _no_garbage_collection() -> Iterator[None]:
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


def _cost(seconds: Sequence[float]) -> Cost:
    """To four significant digits: more would be noise."""
    figures = min(seconds), statistics.median(seconds), statistics.quantiles(seconds, n=20)[-1]
    return Cost(*(Fraction(f"{figure:.4g}") for figure in figures))


def _nonzero(operations: Operations) -> dict[str, int]:
    return {kind: number for kind, number in operations._asdict().items() if number}


Value = TypeVar("Value")


def _by_method(values: Mapping[tuple[str, str], Value]) -> dict[str, dict[str, Value]]:
    result: dict[str, dict[str, Value]] = {}
    for (method, kind), value in values.items():
        result.setdefault(method, {})[kind] = value
    return result
