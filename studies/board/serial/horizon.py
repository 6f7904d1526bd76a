"""Filters at a delayed horizon: exact by replay, or with PX4's output predictor."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from filters.delayed.px4_predictor import STEP_S, TAU_S, pull_gains
from studies.board.serial.method import TEXTS, Parts, Serial, add_arrays, add_correction, add_record
from studies.board.serial.pieces import kept_input
from studies.board.steps import Steps
from studies.board.wanted import Filter


def _memory(parts: Parts) -> None:
    (n, m, _), N = parts.system[:3], parts.steps.N
    add_arrays(parts, path=(N + 1, n), u=(N, m), P=(2, n, n), corrected=(n,))
    add_correction(parts, "update")


def _words(wanted: Filter, _steps: Steps) -> Mapping[str, Any]:
    return {"keep_u": kept_input(wanted.system.inputs, "filter_u[since_k]")}


DELAYED_HORIZON = Serial(
    title="filter at a delayed horizon",
    behaviour="P is never ahead of k; at l the states since k are done again from the corrected one.",
    jobs=("predict", "update", "propagate_covariance"),
    order="after",
    template="delayed_horizon.c",
    texts={
        **TEXTS,
        "predict.j": "k + i",
        "predict.x": "filter_path[i]",
        "predict.u": "filter_u[i]",
        "predict.x_next": "filter_path[i + 1]",
        "propagate_covariance.j": "k + i",
        "propagate_covariance.u": "filter_u[i]",
        "P_next": "filter_P[P_next]",
        "k": "filter.j - DELAY_STEPS",
        "update.before": "&reference",
    },
    memory=_memory,
    fields="    int P; /* which of the covariances in memory */\n"
    "    bool corrected; /* whether the state of k is, and has not landed */\n",
    start="    filter.P = 0;\n    filter.corrected = false;\n",
    x="filter_path[0]",
    now="filter_path[filter.j % CYCLE_STEPS]",
    same={"replay": "predict"},
    words=_words,
)


def _memory_of_predictor(parts: Parts) -> None:
    (n, m, p), M = parts.system[:3], parts.steps.M
    add_arrays(parts, x=(2, n), P=(2, n, n), output=(M + 1, n), u=(M, m), y=(p,), total=(2, n), shift=(n,))
    parts.data.lines.append(f"/* Of a time constant of {TAU_S:g} s and steps of {STEP_S:g} s, as PX4 has them. */")
    add_record(parts, "gains", pull_gains(TAU_S, STEP_S), parts.in_c.parameter("pull", "gains"))
    add_correction(parts, "update")


def _words_of_predictor(wanted: Filter, _steps: Steps) -> Mapping[str, Any]:
    return {"keep_u": kept_input(wanted.system.inputs, "filter_u[filter.j % DELAY_STEPS]")}


PX4_PREDICTOR = Serial(
    title="filter at a delayed horizon, with PX4's output predictor",
    behaviour="The output is approximate: it is drawn after the filter, which is M steps behind, and does not jump.",
    jobs=("predict", "propagate", "update", "pull", "shift_output"),
    order="before",
    template="px4_predictor.c",
    texts={
        **TEXTS,
        "predict.x": "filter_output[filter.j % OUTPUTS]",
        "x_next": "filter_output[(filter.j + 1) % OUTPUTS]",
        "propagate.j": "horizon - 1",
        "propagate.u": "filter_u[filter.j % DELAY_STEPS]",
        "k": "horizon",
        "update.y": "filter_y",
        "pull.x": "filter_x[filter.now]",
        "pull.o": "filter_output[horizon % OUTPUTS]",
        "total": "filter_total[filter.total]",
        "gains": "&filter_gains",
        "total_next": "filter_total[total_next]",
        "shift": "filter_shift",
        "shift_output.o": "filter_output[i]",
        "o_shifted": "filter_output[i]",
    },
    memory=_memory_of_predictor,
    fields="    int now; /* which of the estimates in memory */\n"
    "    int total; /* which of the sums of errors */\n"
    "    bool measured; /* whether a measurement waits for the step */\n",
    start="    for (int i = 0; i < $n; i++) {\n"
    "        filter_output[0][i] = x[i];\n"
    "        filter_total[0][i] = $zero;\n"
    "    }\n"
    "    filter.now = 0;\n    filter.total = 0;\n    filter.measured = false;\n",
    now="filter_output[filter.j % OUTPUTS]",
    words=_words_of_predictor,
)
