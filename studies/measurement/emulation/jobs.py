"""Instructions and stack of jobs on an emulated core.

A job is called again and again, with the same arguments, while SysTick counts; what as many calls of a function take
that does nothing is subtracted, so that of a call only the passing of arguments is left. A job that takes up to 10,000
instructions is called 400 times, one that takes more the less often the longer it is; the end of the clock's tick is
then worth an instruction in ten, or two in a hundred thousand, and the figure is rounded to a whole one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import FunctionType
from typing import Any, NamedTuple, TypeVar

import numpy as np

from filters.jobs import Job
from filters.system import System
from filters.translation.kinds import Kind, kind_of
from filters.translation.library import Precision
from filters.translation.unit import Unit
from studies.measurement.emulation.calls import Calls
from studies.measurement.emulation.targets import Target
from studies.measurement.emulation.toolchain import run

ARGUMENT_SETS = 3

Key = TypeVar("Key")


class Emulated(NamedTuple):
    """instructions: by set of arguments. stack: bytes, the most. shown: by set, the bytes of the arrays among the
    arguments after the call, one after the other; if asked for."""

    instructions: list[int]
    stack: int
    shown: list[bytes]


def sources(jobs: Mapping[Key, Job], precision: Precision) -> tuple[Unit, dict[str, str]]:
    """The jobs as C, filter.c and filter.h.

    Raises:
        Untranslatable: something in one cannot be translated; with its file and line.
    """
    unit = Unit(precision, frozenset(_plain(job) for job in jobs.values()))
    for job in jobs.values():
        unit.function(_plain(job), _kinds(job.arguments(0)))
    return unit, {"filter.h": unit.header("FILTER_H"), "filter.c": unit.source("filter.h")}


def emulate(
    jobs: Mapping[Key, Job], target: Target, precision: Precision, *, sets: int = ARGUMENT_SETS, shows: bool = False
) -> dict[Key, Emulated]:
    """What each job takes.

    Raises:
        Untranslatable: see `sources`.
        ValueError: it cannot be compiled, or fails on the board.
    """
    unit, files = sources(jobs, precision)
    calls = Calls(unit, shows)
    for job in jobs.values():
        translated = unit.function(_plain(job), _kinds(job.arguments(0)))
        for index in range(sets):
            arguments = job.arguments(index)
            _check_parameters(arguments, precision)
            calls.add(translated, arguments)
    counts, shown = counted(run(target, {**files, "jobs.c": calls.text("filter.h")}), target)
    found = {}
    for number, key in enumerate(jobs):
        own = slice(number * sets, (number + 1) * sets)
        found[key] = Emulated([count for count, _ in counts[own]], max(stack for _, stack in counts[own]), shown[own])
    return found


def counted(lines: Sequence[str], target: Target) -> tuple[list[tuple[int, int]], list[bytes]]:
    """Instructions and stack bytes of each call, and the bytes that it shows, of the lines that the board printed."""
    counts, shown, bytes_ = [], [], b""
    for line in lines:
        word, _, rest = line.partition(" ")
        if word == "SHOWN":
            bytes_ += bytes.fromhex(rest)
        elif word == "COUNT":
            repetitions, ticks, none, stack = map(int, rest.split())
            counts.append((round((ticks - none) * target.per_tick / repetitions), stack))
            shown.append(bytes_)
            bytes_ = b""
    return counts, shown


def as_shown(arguments: Any, precision: Precision) -> bytes:
    """The bytes of the arrays among a job's arguments, as a board shows them."""
    if isinstance(arguments, tuple):
        return b"".join(as_shown(item, precision) for item in arguments)
    if isinstance(arguments, np.ndarray):
        as_real = arguments.dtype.kind == "f" and precision == "single"
        return (arguments.astype(np.float32) if as_real else arguments).tobytes()
    return b""


def _check_parameters(arguments: tuple[Any, ...], precision: Precision) -> None:
    for system in arguments:
        if isinstance(system, System) and precision == "single":
            numbers = np.concatenate([np.ravel(each) for each in numbers_of(system.parameters)] or [np.zeros(0)])
            too_large = numbers[np.isfinite(numbers) & (abs(numbers) > np.finfo(np.float32).max)]
            if too_large.size:
                raise ValueError(f"the system has the parameter {too_large[0]:g}, too large for single precision")


def numbers_of(value: Any) -> Iterator[Any]:
    """Arrays and numbers in a value, however deep."""
    if isinstance(value, tuple):
        for item in value:
            yield from numbers_of(item)
    elif isinstance(value, np.ndarray | float | int):
        yield value


def _kinds(arguments: tuple[Any, ...]) -> tuple[Kind, ...]:
    return tuple(kind_of(argument) for argument in arguments)


def _plain(job: Job) -> FunctionType:
    assert isinstance(job.function, FunctionType)
    return job.function
