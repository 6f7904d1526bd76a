"""What is to be known of a method to write it step by step."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np

from filters.jobs import Form, Job, JobKind
from filters.records import new_correction
from filters.samples import sample
from filters.system import System
from filters.translation.data import Data, Kept
from filters.translation.kinds import Kind, Record
from studies.board.jobs import Jobs
from studies.board.memory import add_model, work_placing
from studies.board.steps import Steps
from studies.board.wanted import Filter

Order: TypeAlias = Literal["after", "before", "each"]
"""Whether a measurement is given after the HR step m, or before it; each: one in every step, after it."""


class Parts(NamedTuple):
    """What the memory of a method depends on. data: the declarations so far."""

    data: Data
    system: System
    in_c: Jobs
    steps: Steps


class Serial(NamedTuple):
    """How a method is written.

    title, behaviour: for the header. jobs: kinds of `registry` that are used; more(wanted): functions beside them.
    order: when a measurement is given; takes: whether it must be known at k that one is taken.
    template: its functions, in C. texts: what each parameter of the jobs is given, by its name, or by job.name where
    jobs differ. fields: of its state beside the step. start: lines that begin it. x, P: where the first estimate goes;
    now: where the present one is. memory(parts): declares its arrays. words(wanted): more of the template.
    """

    title: str
    behaviour: str
    jobs: tuple[str, ...]
    order: Order
    template: str
    texts: Mapping[str, str]
    memory: Callable[[Parts], None]
    fields: str = "    int now; /* which of the estimates in memory */\n"
    start: str = "    filter.now = 0;\n"
    x: str = "filter_x[0]"
    P: str = "filter_P[0]"
    now: str = "filter_x[filter.now]"
    takes: bool = False
    same: Mapping[str, str] = {}
    more: Callable[[Filter], Mapping[str, Job]] = lambda _: {}
    words: Callable[[Filter, Steps], Mapping[str, Any]] = lambda _wanted, _steps: {}


TEXTS: Mapping[str, str] = {
    "system": "&filter_model",
    "j": "filter.j",
    "before": "&before",
    "after": "&after",
    "reference": "&reference",
    "u": "u",
    "y": "y",
    "correction": "&filter_correction",
    "work": "&filter_work",
}
"""What parameters are given in most methods."""


def in_flight(steps: Steps) -> int:
    """How many measurements are on their way at once, at most."""
    return -(-steps.M // steps.N)


def as_jobs(wanted: Filter, form: Form, *kinds: JobKind[Form]) -> dict[str, Job]:
    """Functions that are no jobs of their own, with arguments to be tried on."""

    def job(kind: str, function: Callable[..., Any], arguments: Callable[..., tuple[Any, ...]]) -> Job:
        return Job(kind, function, lambda index: arguments(wanted.system, form, _sample(wanted, index)))

    return {kind: job(kind, function, arguments) for kind, function, arguments in kinds}


def _sample(wanted: Filter, index: int) -> Any:
    return sample(wanted.system, 0, index, wanted.x0)


def add_arrays(parts: Parts, **shapes: tuple[int, ...]) -> None:
    """Arrays of zeros, each named `filter_` and its name; none where it would be empty."""
    for name, shape in shapes.items():
        if 0 not in shape:
            parts.data.array(Kept(f"filter_{name}"), np.zeros(shape))


def add_record(parts: Parts, name: str, value: Any, kind: Kind) -> None:
    """A record `filter_name` that points at arrays, all of which are written to."""
    assert isinstance(kind, Record)
    parts.data.record(f"filter_{name}", value, kind, lambda names: Kept("_".join(names)))


def add_correction(parts: Parts, job: str) -> None:
    """z, K and delta_x of the last measurement."""
    add_record(parts, "correction", new_correction(parts.system), parts.in_c.parameter(job, "correction"))


def add_common(parts: Parts, jobs: Mapping[str, Job]) -> None:
    """The model, what the jobs return, and their workspace."""
    data, system, in_c, _ = parts
    data.lines.append("/* The model. Nothing writes to it but to its scratch. */")
    for kind, done in in_c.by_kind.items():
        if "system" in done.used:
            add_model(data, "filter", system, in_c.parameter(kind, "system"))
            break
    data.lines.append("\n/* What jobs return, and their workspace. */")
    for kind, done in in_c.by_kind.items():
        for name, array in done.memory.items():
            data.array(Kept(f"{kind}_{name}"), np.zeros([length or 0 for length in array.shape]))
    for kind, done in in_c.by_kind.items():
        if "work" in done.used:
            work = in_c.parameter(kind, "work")
            assert isinstance(work, Record)
            values = dict(zip(done.parameters, jobs[kind].arguments(0), strict=True))
            data.record("filter_work", values["work"], work, work_placing(in_c.fields(work)))
            break
    data.lines.append("\n/* What is kept from step to step. */")
