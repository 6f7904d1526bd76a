"""The dual rate filter as two tasks, with several measurements or corrections on their way at once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from filters.jobs import Job
from filters.kernels.dense import matvec
from filters.translation.data import Data, Kept
from sched_sim.errors import InputError, option
from studies.board.dual_rate import add_models, add_own, check_landing, one_of, record_name, task_words
from studies.board.jobs import Jobs, call
from studies.board.steps import Files, Steps
from studies.board.template import filled
from studies.board.wanted import Filter


def are_several(steps: Steps) -> bool:
    """Whether another measurement is taken before one arrives, or before its correction lands."""
    return steps.M >= steps.N or steps.L > steps.N


def check_in_flight(steps: Steps, gain: str) -> None:
    """Raises InputError unless the tasks can have these steps, and this time for the gain."""
    check_landing(steps)
    if gain != "at-update":
        raise InputError(
            f"{option('gain')} {gain} is not written as C for several measurements on their way: leave it out, or give "
            f"{option('M')} less than {option('N')}, and {option('L')} at most {option('N')}"
        )


def most_in_flight(steps: Steps) -> int:
    """How many corrections are on their way at once."""
    return -(-steps.L // steps.N)


def slots(steps: Steps) -> int:
    """Of messages: as many as are on their way, and as many again that those at hand still need."""
    return 2 * most_in_flight(steps)


def more_jobs(jobs: Mapping[str, Job]) -> dict[str, Job]:
    """What the tasks do beside their jobs: a correction goes by Phi over whole cycles."""

    def arguments(index: int) -> tuple[Any, ...]:
        _form, x, Phi, delta_x, *_ = jobs["hr_update"].arguments(index)
        return Phi, delta_x, np.zeros_like(x)

    return {"hr_pass": Job("hr_pass", matvec, arguments), "lr_carry": jobs["hr_update"]}


def tasks_in_flight(wanted: Filter, jobs: Mapping[str, Job], in_c: Jobs, steps: Steps) -> Files:
    """The files tasks.h, tasks.c and state.h."""
    data = _memory(wanted, jobs, in_c, steps)
    calls = _calls(in_c)
    words = {
        **task_words(wanted, in_c, steps),
        "late": _LATE.format(most_in_flight(steps)),
        "more_steps": f", SLOTS = {slots(steps)}",
        "memory": "\n".join(data.lines),
        "zero": in_c.unit.number(0.0),
        "Transition": record_name(in_c, "lr_propagate", "transition"),
        "Estimate": record_name(in_c, "lr_update", "reference"),
        "Correction": record_name(in_c, "lr_update", "correction"),
        **calls,
        "hr_propagate": calls[one_of(in_c, "hr_propagate")],
    }
    templates = {"tasks.h": "tasks.h", "tasks.c": "tasks_in_flight.c", "state.h": "state_in_flight.h"}
    return Files({name: filled(template, words) for name, template in templates.items()}, data.sizes)


_LATE = """   Up to {} corrections are on their way at once, in the order of their k. Where there is no room for one
   more, the measurement of that k is left out (HR_SKIPPED): the filter stays exact, as if it had been lost."""


def _calls(in_c: Jobs) -> dict[str, str]:
    texts = {
        "j": "hr.j",
        "u": "u",
        "x": "hr_x[hr.x]",
        "x_next": "hr_x[x_next]",
        "transition": "&hr.transition",
        "following": "&following",
        "hr_update.Phi_from_k": "hr.transition.Phi",
        "hr_update.delta_x": "hr_carried[carried]",
        "x_corrected": "hr_x[corrected]",
        "hr_pass.A": "message_Phi[c % SLOTS]",
        "hr_pass.x": "hr_carried[from]",
        "hr_pass.out": "hr_carried[carried]",
        "k": "message_k[slot]",
        "y": "y",
        "P": "lr_P[lr.posterior]",
        "P_next": "lr_P[lr.prior]",
        "P_posterior": "lr_P[lr.posterior]",
        "reference": "&reference",
        "correction": "&correction",
        "lr_propagate.transition": "&transition",
        "lr_carry.x": "plus",
        "lr_carry.Phi_from_k": "message_Phi[c % SLOTS]",
        "lr_carry.delta_x": "lr_carried[from]",
        "lr_carry.x_corrected": "lr_carried[carried]",
    }
    calls = {}
    for kind, job in in_c.by_kind.items():
        own = {**texts, "system": f"&{kind[:2]}_model", "work": f"&{kind[:2]}_work"}
        given = {name: own.get(f"{kind}.{name}", own.get(name, name)) for name in job.used}
        calls[kind] = call(job, given, {name: f"{kind}_{name}" for name in job.memory})
    return calls


def _memory(wanted: Filter, jobs: Mapping[str, Job], in_c: Jobs, steps: Steps) -> Data:
    system, count = wanted.system, slots(steps)
    data, (n, _, p) = Data(in_c.unit), system[:3]
    add_models(data, system, in_c)

    def arrays(task: str, **shapes: tuple[int, ...]) -> None:
        for name, shape in shapes.items():
            data.array(Kept(f"{task}_{name}"), np.zeros(shape))

    data.lines.append(
        "\n/* HR: x_j, Phi_{k->j} and Q_{k->j}, two of each in turn; a correction on its way; its workspace. */"
    )
    arrays("hr", x=(2, n), Phi=(2, n, n), Q=(2, n, n), carried=(2, n))
    add_own(data, "hr", system, jobs, in_c)
    data.lines.append("\n/* From HR to LR: x_{k^-}, and Phi and Q over the cycle before. */")
    arrays("message", x=(count, n), Phi=(count, n, n), Q=(count, n, n))
    data.lines.append("\n/* LR: P_{k^-} and P_{k^+}; z and K; corrections in their slots; its workspace. */")
    arrays("lr", P=(2, n, n), z=(p,), K=(n, p), delta_x=(count, n), carried=(2, n))
    add_own(data, "lr", system, jobs, in_c)
    return data
