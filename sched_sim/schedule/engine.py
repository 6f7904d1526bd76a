"""Which engine runs a simulation: SimPy, or machine code. Both follow the same rules, each is the other's oracle."""

from __future__ import annotations

from typing import Literal, TypeAlias, get_args

from sched_sim.bounds import short
from sched_sim.compiled import compiles
from sched_sim.errors import InputError, option

Engine: TypeAlias = Literal["auto", "simpy", "compiled"]

MANY_JOBS = 1_000_000
"""From so many on, machine code is loaded, or else compiled, in less time than it saves."""

MOST_TICKS = 2**61
"""A horizon in machine code is shorter: sums of a few times fit into 64 bits."""


def check_engine(engine: Engine) -> None:
    """Raises InputError for an engine that is not there."""
    if engine not in get_args(Engine):
        raise InputError(f"{option('engine')} is {short(repr(engine))}: choose from {', '.join(get_args(Engine))}")


def is_compiled(engine: Engine, jobs: int, *, holds: bool, only_simpy: str = "", many: int | None = None) -> bool:
    """Whether machine code runs it.

    jobs: about how many are simulated; holds: whether 64 bits hold its times; only_simpy: what was asked for that SimPy
    alone can, by name; many: from so many on it is taken unasked, `MANY_JOBS` if not given. Raises InputError where
    machine code was asked for, and cannot.
    """
    if engine != "compiled":
        wanted = engine == "auto" and jobs >= (MANY_JOBS if many is None else many) and holds and not only_simpy
        return wanted and compiles()
    if only_simpy:
        raise InputError(f"{option('engine')} compiled has no {only_simpy}: leave one of them out")
    if not holds:
        raise InputError(
            f"{option('engine')} compiled: times and work in the ticks in which all is whole do not fit into 64 bits; "
            f"give {option('engine')} simpy, which takes any, or costs and times with fewer digits"
        )
    if not compiles():
        raise InputError(f"NUMBA_DISABLE_JIT is set: unset it, or give {option('engine')} simpy")
    return True
