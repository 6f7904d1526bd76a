"""What each job of each filter costs, from its real code: counted, compiled, as NumPy calls, or on an emulated core.

How the timed backends go about it: see `job_times`. A round gives one figure per job: its mean time. Minimum, median
and 95th percentile are over rounds.
"""

from __future__ import annotations

import platform
import statistics
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from fractions import Fraction
from importlib.metadata import version
from typing import Any, Literal, TypeVar, get_args

from filters.arrays import as_array
from filters.backends.c_compiler import FLAGS, NoCompiler, compiler, compiler_version
from filters.backends.counted import Operations, count
from filters.backends.uncountable import UncountableError
from filters.choice import check_choice
from filters.covariance_forms import COVARIANCE_FORMS, CovarianceFormName
from filters.jobs import Job
from filters.problem import check_system
from filters.registry import ALL_METHODS, SPARSE_METHODS
from filters.seed import check_seed
from filters.system import System
from sched_sim.costs.table import Cost, CostTable
from sched_sim.errors import InputError, option
from studies.measurement.emulation.table import emulated_table
from studies.measurement.emulation.targets import precision_of, target_of
from studies.measurement.executions import Wanted
from studies.measurement.job_times import ARGUMENT_SETS, Progress, Protocol, silent, time_jobs
from studies.measurement.own_functions import with_own, with_shares

BackendName = Literal["compiled", "counted", "numpy", "c", "emulated"]

QUICK = Protocol(rounds=61, repetitions=1000)
THOROUGH = Protocol(rounds=601, repetitions=1000)
QUICK_NUMPY = Protocol(rounds=61, repetitions=10)
THOROUGH_NUMPY = Protocol(rounds=201, repetitions=30)


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
    methods: Sequence[str] | None = None,
    sparse: bool = False,
    own: bool = False,
    target: str | None = None,
    precision: str | None = None,
) -> CostTable:
    """The cost table of these methods on one system.

    unit: "operation" (each multiply, add, divide, square root counts one) for counted, "instruction" for emulated, else
        "second".
    update: the covariance form, of no use to methods that keep factors of the covariance.
    x0 (n,): a typical state of the system, zero if not given.
    methods: all, if not given, or all that can be sparse.
    sparse: leave out the zeros and ones that the system states, see `System.structure`; NumPy cannot.
    target: of emulated code, the core, see `emulation.targets`; precision: that of the core if not given.
    own: of compiled code, time the functions of the system too: the table's `own_share` is that of each job.

    Raises InputError for an argument that is none of these, if the standard filter, with which typical arguments are
    made, cannot be run from there, if a function of the system cannot be counted, compiled or translated to C, or if
    the emulator or its compiler is missing.
    """
    try:
        check_system("system", system)
        check_choice("backend", backend, get_args(BackendName))
        check_choice("update", update, COVARIANCE_FORMS)
        check_seed(seed)
        names = methods if methods is not None else SPARSE_METHODS if sparse else tuple(ALL_METHODS)
        _check_methods(names)
        if sparse:
            _check_sparse(system, backend, names)
        _check_state(x0, system.states)
    except ValueError as error:
        raise InputError(str(error)) from None
    system = system if sparse else system._replace(structure=None)
    jobs = {
        (method, kind): job
        for method in names
        for kind, job in ALL_METHODS[method].jobs(system, update, seed, x0).items()
    }
    own = own and backend == "compiled"
    timed = with_own(jobs, system, seed, x0) if own else jobs
    about = {
        "update_form": update,
        "structure": "sparse" if sparse else "dense",
        "states": system.states,
        "inputs": system.inputs,
        "measurements": system.measurements,
    }
    try:
        table = cost_table(
            timed,
            backend,
            about,
            name=name,
            thorough=thorough,
            seed=seed,
            progress=progress,
            target=target,
            precision=precision,
        )
        return with_shares(table, timed) if own else table
    except InputError:
        raise
    except ValueError as error:
        raise InputError(f"the system cannot be filtered from its typical state: {error}") from error


def _check_methods(methods: Sequence[str]) -> None:
    if isinstance(methods, str) or not isinstance(methods, Sequence) or not methods:
        raise ValueError(f"methods={methods!r:.60}: give a list of some of {', '.join(ALL_METHODS)}")
    for method in methods:
        check_choice("methods", method, ALL_METHODS)


def _check_sparse(system: System, backend: BackendName, methods: Sequence[str]) -> None:
    if system.structure is None:
        raise ValueError("sparse=True: the system states no structure; give it one, system._replace(structure=...)")
    if backend == "numpy":
        raise ValueError("sparse=True: backend='numpy' multiplies whole matrices; give another backend")
    if dense := [method for method in methods if method not in SPARSE_METHODS]:
        raise ValueError(
            f"sparse=True: {', '.join(dense)} multiplies zeros too; give some of {', '.join(SPARSE_METHODS)}"
        )


def _check_state(x0: Any, states: int) -> None:
    if x0 is not None and (shape := as_array("x0", x0).shape) != (states,):
        raise ValueError(f"x0 has the shape {shape}; give ({states},), a value for each state of the system")


def cost_table(
    jobs: Mapping[tuple[str, str], Job],
    backend: BackendName,
    about: Mapping[str, Any],
    *,
    name: str,
    thorough: bool = False,
    seed: int = 0,
    progress: Progress = silent,
    target: str | None = None,
    precision: str | None = None,
) -> CostTable:
    """The cost table of these jobs, by method and kind; about: what else is to be said of them."""
    about = {"backend": backend, **about}
    if backend == "emulated":
        core = target_of(target)
        return emulated_table(jobs, core, precision_of(core, precision), about, name=name, progress=progress)
    if backend == "counted":
        operations = counted(jobs, progress)
        about["source"] = COUNTED_SOURCE
        costs = {key: Cost.of(Fraction(tally.total)) for key, tally in operations.items()}
        counts = {key: nonzero(tally) for key, tally in operations.items()}
        return CostTable(name, "operation", _by_method(costs), about, operations=_by_method(counts))
    if backend == "c":
        _check_compiler()
    protocol = _protocol(backend, thorough)
    timed = time_jobs(jobs, backend, protocol, seed, progress)
    about |= {
        "source": "means over the repetitions of a round; minimum, median and 95th percentile over rounds",
        **where_timed(protocol, seed, timed.busy),
        **({"compiler": f"{compiler_version()}, {' '.join(FLAGS)}"} if backend == "c" else {}),
    }
    return CostTable(name, "second", _by_method({key: _cost(rounds) for key, rounds in timed.seconds.items()}), about)


def _check_compiler() -> None:
    try:
        compiler()
    except NoCompiler as error:
        name = option("backend")
        raise InputError(f"{name} c needs a C compiler: {error}, or choose {name} compiled") from None


COUNTED_SOURCE = "exact operation counts: multiply, add, divide, square root, function count one each"
"""What a cost table says of counts."""

Key = TypeVar("Key")


def counted(jobs: Mapping[Key, Job], progress: Progress = silent) -> dict[Key, Operations]:
    """The exact operations of each job.

    Raises InputError for a job with a function of the user's that cannot be counted.
    """
    operations = {}
    for number, (key, job) in enumerate(jobs.items()):
        progress(number, len(jobs), "jobs")
        try:
            operations[key] = count(job.function, *job.arguments(0))
        except UncountableError as error:
            raise InputError(f"{error}, or time it with another --backend") from error
    return operations


def where_timed(protocol: Protocol | Wanted, seed: int, busy: str) -> dict[str, Any]:
    """The machine, the day, the versions and the protocol of what was timed just now; busy: what says that the machine
    was."""
    return {
        **({"busy": busy} if busy else {}),
        "machine": machine(),
        "date": datetime.now(UTC).date().isoformat(),
        "versions": versions(),
        "protocol": {**protocol._asdict(), "argument_sets": ARGUMENT_SETS, "seed": seed},
    }


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


def _cost(seconds: Sequence[float]) -> Cost:
    """To four significant digits: more would be noise."""
    figures = min(seconds), statistics.median(seconds), statistics.quantiles(seconds, n=20)[-1]
    return Cost(*(Fraction(f"{figure:.4g}") for figure in figures))


def nonzero(operations: Operations) -> dict[str, int]:
    """The kinds that there are."""
    return {kind: number for kind, number in operations._asdict().items() if number}


Value = TypeVar("Value")


def _by_method(values: Mapping[tuple[str, str], Value]) -> dict[str, dict[str, Value]]:
    result: dict[str, dict[str, Value]] = {}
    for (method, kind), value in values.items():
        result.setdefault(method, {})[kind] = value
    return result
