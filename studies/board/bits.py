"""A program that runs each job on given arguments, and compares what it leaves with what Python left."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from filters.jobs import Job
from filters.records import Workspace
from filters.system import System
from filters.translation.data import Data, Kept, Placing, rounded
from filters.translation.declarations import variable
from filters.translation.kinds import Array, Kind, Nothing, Record, lasts
from filters.translation.names import c_name
from studies.board.jobs import Jobs, call, plain
from studies.board.memory import each_array, model_placing
from studies.board.template import filled

ARGUMENTS = 1
"""Which set of arguments a job is run on."""


class Left(NamedTuple):
    """An array that a job has filled or returned. text: in C."""

    text: str
    value: Any


def test_c(jobs: Mapping[str, Job], timed: Mapping[str, str], in_c: Jobs, more: Mapping[str, str]) -> str:
    """The file test.c. timed: kinds of the cost table, and which of the jobs each is; more: words of the template for
    what is compared beside the jobs.

    jobs: with all products, whose numbers those of sparse ones must be: a zero that is none is found here.
    """
    data = Data(in_c.unit)
    shared: dict[int, tuple[Any, Any]] = {}
    functions = [_of_job(kind, job, in_c, data, shared) for kind, job in jobs.items()]
    values = {
        "data": "\n".join(data.lines),
        "jobs": "\n".join(functions),
        "calls": "\n".join(f"    {kind}_test();" for kind in jobs),
        "times": "\n".join(f'    timed("{kind}", {job}_run);' for kind, job in timed.items()),
    }
    return filled("test.c", {**values, **more})


def _of_job(kind: str, job: Job, in_c: Jobs, data: Data, shared: dict[int, tuple[Any, Any]]) -> str:
    """What runs it, and what compares. shared: see `rounded`."""
    done, unit = in_c.by_kind[kind], in_c.unit
    arguments = rounded(_apart(job.arguments(ARGUMENTS)), unit.precision, shared)
    given = {name: (value, part) for name, value, part in zip(done.parameters, arguments, done.kinds, strict=True)}
    texts = {name: _argument(f"{kind}_{name}", *given[name], data) for name in done.used}
    memory = {name: f"{kind}_{name}" for name in done.memory}
    for name, array in done.memory.items():
        data.array(Kept(memory[name]), np.zeros([length or 0 for length in array.shape]))
    run = f"{call(done, texts, memory)};"
    if not isinstance(done.result, Nothing):
        data.lines.append(f"static {variable(done.result, f'{kind}_result', unit.record_name)};")
        run = f"{kind}_result = {run}"
    lines = [f"    {kind}_run();", f'    begin("{kind}");']
    for index, left in enumerate(_left(job, kind, arguments, texts, in_c)):
        name = f"{kind}_expected_{index}"
        data.array(Kept(name, constant=True), np.ravel(left.value))
        lines.append(f"    compare((const real *){left.text}, {name}, {left.value.size});")
    return f"static void {kind}_run(void)\n{{\n    {run}\n}}\n\nstatic void {kind}_test(void)\n{{\n" + "\n".join(
        [*lines, "    end();", "}", ""]
    )


def _apart(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """Without what a model keeps in its scratch, where others write to it."""
    return tuple(value if isinstance(value, System) else each_array(value, np.copy) for value in arguments)


def _argument(name: str, value: Any, kind: Kind, data: Data) -> str:
    """The text of an argument, behind its declarations."""
    if not isinstance(kind, Record):
        text = data.text(value, kind, (name,), lambda names: Kept("_".join(names)))
        return f"{text}, {len(value)}" if isinstance(kind, Array) and kind.is_long else text
    placing: Placing = model_placing("test") if isinstance(value, System) else lambda names: Kept("_".join(names))
    data.record(name, value, kind, placing)
    return f"&{name}"


def _left(job: Job, kind: str, arguments: tuple[Any, ...], texts: Mapping[str, str], in_c: Jobs) -> Iterator[Left]:
    """What Python changes among the arguments, but for workspaces, and what it returns."""
    done = in_c.by_kind[kind]
    before, after = each_array(arguments, np.copy), each_array(arguments, np.copy)
    with np.errstate(all="ignore"):
        returned = plain(job)(*after)
    for name, part, old, new in zip(done.parameters, done.kinds, before, after, strict=True):
        if name in texts and not isinstance(new, Workspace | System):
            yield from _changed(texts[name], old, new, part)
    yield from _changed(f"{kind}_result", None, returned, done.result)


def _changed(text: str, old: Any, new: Any, kind: Kind) -> Iterator[Left]:
    match kind:
        case Array(item="real") if new.size and (old is None or not np.array_equal(old, new, equal_nan=True)):
            yield Left(text.partition(",")[0], new)
        case Record(fields=fields):
            base = f"{text[1:]}." if text.startswith("&") else f"{text}."
            for index, (name, part) in enumerate(fields):
                if lasts(part):
                    yield from _changed(f"{base}{c_name(name)}", None if old is None else old[index], new[index], part)
