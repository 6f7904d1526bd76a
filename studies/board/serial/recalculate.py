"""The recalculating filter: back to k, and all steps since again."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from studies.board.serial.method import TEXTS, Parts, Serial, add_arrays, add_correction
from studies.board.serial.pieces import kept_input
from studies.board.steps import Steps
from studies.board.wanted import Filter


def _memory(parts: Parts) -> None:
    n, slots = parts.system.states, _references(parts.steps)
    add_arrays(parts, x=(2, n), P=(2, n, n), x_at_k=(slots, n), P_at_k=(slots, n, n))
    add_arrays(parts, u=(parts.steps.M, parts.system.inputs))
    add_correction(parts, "update")


def _references(steps: Steps) -> int:
    """How many steps k there are from one to its m."""
    return steps.M // steps.N + 1


def _words(wanted: Filter, steps: Steps) -> Mapping[str, Any]:
    m = wanted.system.inputs
    return {
        "references": _references(steps),
        "keep_u": kept_input(m, "filter_u[filter.j % DELAY_STEPS]"),
        "and_u_parameter": f", real u[{m}]" if m else "",
        "and_u": ", u" if m else "",
        "and_kept_u": ", filter_u[i % DELAY_STEPS]" if m else "",
    }


RECALCULATE = Serial(
    title="recalculating filter",
    behaviour="A late measurement is used at k, and the steps since are done again.",
    jobs=("propagate", "update"),
    order="after",
    template="recalculate.c",
    texts={**TEXTS, "j": "j", "k": "k", "update.before": "&reference"},
    memory=_memory,
    start="    filter.now = 0;\n    keep_reference(0);\n",
    same={"replay": "propagate"},
    words=_words,
)
