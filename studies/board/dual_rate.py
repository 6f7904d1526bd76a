"""The dual rate filter as two tasks that an RTOS calls, with all their memory."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from filters.jobs import Job
from filters.records import new_correction, new_workspace
from filters.system import System
from filters.translation.data import Data, Kept
from filters.translation.kinds import Kind, Record
from sched_sim.errors import InputError, option
from studies.board.jobs import Jobs, call, translated
from studies.board.memory import add_model, add_workspace
from studies.board.steps import Files, Steps
from studies.board.template import filled
from studies.board.wanted import Filter

TASKS = ("hr", "lr")
"""The names of the jobs of each begin so."""


def kinds(wanted: Filter) -> tuple[str, ...]:
    """The jobs that are written."""
    propagate = "hr_propagate" if wanted.low_rate_noise == "exact" else f"hr_propagate_{wanted.low_rate_noise}"
    measured = ("lr_update",) if wanted.gain == "at-update" else ("lr_gain", "lr_correct")
    return "hr_restart", propagate, "hr_update", "lr_propagate", *measured


def check_choices(low_rate_noise: str) -> None:
    """Raises InputError for a noise that is not written as C."""
    if low_rate_noise == "euler":
        raise InputError(
            f"{option('low_rate_noise')} euler is not written as C, for its halves are of other steps in each cycle: "
            f"give exact or sum"
        )


def check_steps(steps: Steps) -> None:
    """Raises InputError unless N is 2 or more, and 0 <= M < L: a correction lands behind the arrival."""
    N = steps.N
    if N < 2:
        raise InputError(
            f"{option('N')} {N} must be at least 2: the dual rate filter spreads an update over several HR steps; "
            f"for a measurement in every step choose {option('method')} standard"
        )
    check_landing(steps)


def check_landing(steps: Steps) -> None:
    """Raises InputError unless 0 <= M < L."""
    _, M, L = steps
    if M < 0:
        raise InputError(f"{option('M')} {M} must be 0 or more: it is the delay of the measurement in HR steps")
    if L <= M:
        raise InputError(
            f"{option('L')} {L} must be more than {option('M')} {M}: as C the correction lands behind the arrival"
        )


def tasks(wanted: Filter, jobs: Mapping[str, Job], in_c: Jobs, steps: Steps) -> Files:
    """The files tasks.h, tasks.c and state.h. in_c: those of `kinds`."""
    system, early = wanted.system, wanted.gain == "precomputed"
    calls = _calls(in_c)
    data = _memory(system, jobs, in_c)
    values = {
        **task_words(wanted, in_c, steps),
        "late": "   If that is not before the next k, the measurement of that k is left out (HR_SKIPPED): the filter\n"
        "   stays exact, as if it had been lost.",
        "more_steps": "",
        "Transition": record_name(in_c, one_of(in_c, "hr_propagate"), "transition"),
        "Estimate": record_name(in_c, "lr_gain" if early else "lr_update", "reference"),
        "memory": "\n".join(data.lines),
        **calls,
        "hr_propagate": calls[one_of(in_c, "hr_propagate")],
        "at_k": _gain_at_k(in_c, calls) if early else "",
        "at_m": "" if early else "    lr.posterior = 1 - lr.prior;\n",
        "lr_update": calls["lr_correct" if early else "lr_update"],
    }
    return Files({name: filled(name, values) for name in ("tasks.h", "tasks.c", "state.h")}, data.sizes)


def _gain_at_k(in_c: Jobs, calls: Mapping[str, str]) -> str:
    """What LR does at k where the gain is computed early (III.D)."""
    return filled("tasks_gain.c", {**calls, "Estimate": record_name(in_c, "lr_gain", "reference")})


def task_words(wanted: Filter, in_c: Jobs, steps: Steps) -> dict[str, Any]:
    """Words of the templates, however many corrections are on their way."""
    n, m, p = wanted.system[:3]
    reads_u = any("u" in job.used for job in in_c.by_kind.values())
    return {
        **{"n": n, "m": m, "p": p, **steps._asdict()},
        "u_parameter": f"real u[{m}]" if m else "void",
        "u_doc": ", with the input u of the step before" if m else "",
        "unused_u": "    (void)u; /* the model does not ask for it */\n" if m and not reads_u else "",
    }


def one_of(in_c: Jobs, kind: str) -> str:
    """The job of this kind, whatever its noise."""
    return next(name for name in in_c.by_kind if name.startswith(kind))


def record_name(jobs: Jobs, kind: str, name: str) -> str:
    record = jobs.parameter(kind, name)
    assert isinstance(record, Record)
    return jobs.unit.record_name(record)


def _calls(jobs: Jobs) -> dict[str, str]:
    high = {
        "system": "&hr_model",
        "j": "hr.j",
        "x": "hr_x[hr.x]",
        "u": "u",
        "x_next": "hr_x[x_next]",
        "transition": "&hr.transition",
        "following": "&following",
        "work": "&hr_work",
        "Phi_from_k": "hr.transition.Phi",
        "delta_x": "lr_correction.delta_x",
        "x_corrected": "hr_x[corrected]",
    }
    low = {
        "system": "&lr_model",
        "k": "message.k",
        "y": "y",
        "P": "lr_P[lr.posterior]",
        "P_next": "lr_P[lr.prior]",
        "P_posterior": "lr_P[lr.posterior]",
        "reference": "&reference",
        "correction": "&lr_correction",
        "transition": "&message.transition",
        "work": "&lr_work",
    }
    return {
        kind: call(job, high if kind.startswith("hr") else low, {name: f"{kind}_{name}" for name in job.memory})
        for kind, job in jobs.by_kind.items()
    }


def _memory(system: System, jobs: Mapping[str, Job], in_c: Jobs) -> Data:
    """The declarations of the model, of HR and of LR."""
    data, n = Data(in_c.unit), system.states
    add_models(data, system, in_c)
    data.lines.append(
        "\n/* HR: x_j, Phi_{k->j} and Q_{k->j}, three of each in turn; what F makes at k; its workspace. */"
    )
    data.array(Kept("hr_x"), np.zeros((3, n)))
    data.array(Kept("hr_Phi"), np.zeros((3, n, n)))
    data.array(Kept("hr_Q"), np.zeros((3, n, n)))
    add_own(data, "hr", system, jobs, in_c)
    data.lines.append("\n/* LR: P_{k^-} and P_{k^+}; z, K and delta_x_{k^+}; its workspace. */")
    data.array(Kept("lr_P"), np.zeros((2, n, n)))
    kind = _parameter(in_c, "lr", "correction")
    assert isinstance(kind, Record)
    data.record("lr_correction", new_correction(system), kind, lambda names: Kept("_".join(names)))
    add_own(data, "lr", system, jobs, in_c)
    return data


def add_models(data: Data, system: System, in_c: Jobs) -> None:
    """The model, as each task sees it."""
    data.lines.append("/* The model. Nothing writes to it but to its scratch, of which each task has its own. */")
    for task in TASKS:
        if (kind := _parameter(in_c, task, "system")) is not None:
            add_model(data, task, system, kind)


def add_own(data: Data, task: str, system: System, jobs: Mapping[str, Job], in_c: Jobs) -> None:
    """Memory of what its jobs return, and its workspace."""
    own = {kind: job for kind, job in jobs.items() if kind.startswith(task)}
    for kind in own:
        for name, array in in_c.by_kind[kind].memory.items():
            data.array(Kept(f"{kind}_{name}"), np.zeros([length or 0 for length in array.shape]))
    if (work := _parameter(in_c, task, "work")) is not None:
        assert isinstance(work, Record)
        alone = translated(own, in_c.unit.precision)
        add_workspace(data, task, new_workspace(system), work, alone.fields(work))


def _parameter(in_c: Jobs, task: str, name: str) -> Kind | None:
    """What it is in C, where a job of the task takes it."""
    for kind, job in in_c.by_kind.items():
        if kind.startswith(task) and name in job.used:
            return in_c.parameter(kind, name)
    return None
