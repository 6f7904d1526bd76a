"""Methods that do all in the HR step: one function for it, one for a measurement that arrives, and their memory."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from filters.records import new_correction, new_workspace
from filters.system import System
from filters.translation.data import Data, Kept
from filters.translation.kinds import Record
from sched_sim.errors import InputError, option
from studies.board.jobs import Jobs, call
from studies.board.memory import add_model, add_workspace
from studies.board.steps import Files, Steps
from studies.board.template import filled


class Serial(NamedTuple):
    """title, behaviour: for the header. jobs: those that are used. estimates: how many are in memory."""

    title: str
    behaviour: str
    jobs: tuple[str, ...]
    estimates: int


SERIAL: Mapping[str, Serial] = {
    "standard": Serial(
        "Kalman filter", "A measurement is used in the step in which it is taken.", ("propagate", "update"), 2
    ),
    "recalculate": Serial(
        "recalculating filter",
        "A late measurement is used at k, and the steps since are done again.",
        ("propagate", "update"),
        3,
    ),
    "larsen": Serial(
        "filter by Larsen's method",
        "A late measurement is used at m, with Phi from k to m (Eqs. 20, 21).",
        ("propagate", "propagate_accumulate", "update"),
        3,
    ),
}


def check_serial(method: str, steps: Steps) -> None:
    """Raises InputError unless 0 < M < N; the standard filter has M = 0."""
    N, M, _ = steps
    least = 1 if method == "standard" else 2
    if least > N:
        raise InputError(
            f"{option('N')} {N} must be at least {least}: it is the HR steps from one measurement to the next"
        )
    if method != "standard" and not 0 < M < N:
        raise InputError(
            f"{option('M')} {M} must be from 1 to {N - 1}: as C, {method} has one measurement on its way at a time; "
            f"without delay choose {option('method')} standard"
        )


def steps_files(method: str, system: System, in_c: Jobs, steps: Steps) -> Files:
    """The files steps.h, steps.c and state.h."""
    n, m, p = system.states, system.inputs, system.measurements
    kind = in_c.parameter("propagate", "before")
    assert isinstance(kind, Record)
    data = _memory(method, system, in_c, steps)
    reads = in_c.by_kind["propagate"].used
    unused_u = "    (void)u; /* the model does not ask for it */\n" if m and "u" not in reads else ""
    values = {
        **{"n": n, "m": m, "p": p, "N": steps.N, "M": steps.M},
        "title": SERIAL[method].title,
        "behaviour": SERIAL[method].behaviour,
        "u_parameter": f"real u[{m}]" if m else "void",
        "u_doc": ", with the input u of the step before" if m else "",
        "and_u_parameter": f", real u[{m}]" if m else "",
        "and_u": ", u" if m else "",
        "and_kept_u": ", filter_u[i]" if m else "",
        "unused_u": unused_u,
        "unused": ("" if "j" in reads else "    (void)j;\n") + unused_u,
        "keep_u": _KEEP_U.replace("$m", str(m)) if m else "",
        "Estimate": in_c.unit.record_name(kind),
        "memory": "\n".join(data.lines),
        "more": f"\n    real (*Phi)[{n}]; /* from k to j */\n    int slot;" if method == "larsen" else "",
        **_calls(method, in_c),
    }
    source = filled("steps_head.c", values) + filled(f"steps_{method}.c", values)
    state = filled("steps_state.h", values)
    return Files({"steps.h": filled("steps.h", values), "steps.c": source, "state.h": state}, data.sizes)


_KEEP_U = """    if (since_k < DELAY_STEPS) { /* which will be done again */
        for (int i = 0; i < $m; i++) {
            filter_u[since_k][i] = u[i];
        }
    }
"""


def _calls(method: str, in_c: Jobs) -> dict[str, str]:
    texts = {
        "system": "&filter_model",
        "j": "j" if method == "recalculate" else "filter.j",
        "k": "filter.j" if method == "standard" else "filter.j - DELAY_STEPS",
        "before": "&before",
        "after": "&after",
        "reference": "&reference",
        "u": "u",
        "y": "y",
        "correction": "&filter_correction",
        "work": "&filter_work",
        "Phi_from_k": "filter.Phi",
        "Phi_next": "filter_Phi[filter.slot]",
    }
    return {
        kind: call(job, texts, {name: f"{kind}_{name}" for name in job.memory}) for kind, job in in_c.by_kind.items()
    }


def _memory(method: str, system: System, in_c: Jobs, steps: Steps) -> Data:
    """The declarations."""
    data, n = Data(in_c.unit), system.states
    estimates, kinds = SERIAL[method].estimates, SERIAL[method].jobs
    data.lines.append("/* The model. Nothing writes to it but to its scratch. */")
    for kind in kinds:
        if "system" in in_c.by_kind[kind].used:
            add_model(data, "filter", system, in_c.parameter(kind, "system"))
            break
    data.lines.append("\n/* Estimates and covariances in turn; z, K and delta_x of the last measurement; workspace. */")
    data.array(Kept("filter_x"), np.zeros((estimates, n)))
    data.array(Kept("filter_P"), np.zeros((estimates, n, n)))
    if method == "larsen":
        data.array(Kept("filter_Phi"), np.zeros((2, n, n)))
    if method == "recalculate" and system.inputs:
        data.array(Kept("filter_u"), np.zeros((steps.M, system.inputs)))
    for kind, job in in_c.by_kind.items():
        for name, array in job.memory.items():
            data.array(Kept(f"{kind}_{name}"), np.zeros([length or 0 for length in array.shape]))
    correction, work = in_c.parameter("update", "correction"), in_c.parameter("update", "work")
    assert isinstance(correction, Record)
    assert isinstance(work, Record)
    data.record("filter_correction", new_correction(system), correction, lambda names: Kept("_".join(names)))
    add_workspace(data, "filter", new_workspace(system), work, in_c.fields(work))
    return data
