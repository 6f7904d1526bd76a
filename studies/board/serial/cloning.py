"""Stochastic cloning: what is carried from k to m is W, the covariance of the state with the measurement."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from filters.covariance_forms import covariance_form
from filters.delayed.clone import sampled, start_arguments
from filters.delayed.cloned import cross, divide, new_clone
from filters.jobs import Job
from filters.records import Sample, new_workspace
from filters.system import System
from studies.board.serial.method import (
    TEXTS,
    Parts,
    Serial,
    add_arrays,
    add_record,
    as_jobs,
    in_flight,
)
from studies.board.wanted import Filter

BEHAVIOUR = "A late measurement is used at m, before that step, with the covariance W that is carried from k."


def _memory(parts: Parts) -> None:
    n, p = parts.system.states, parts.system.measurements
    add_arrays(parts, x=(2, n), P=(2, n, n), W=(2, n, p), z=(p,))
    add_record(parts, "clone", new_clone(parts.system), parts.in_c.parameter("start", "clone"))


CLONE = Serial(
    title="filter by stochastic cloning",
    behaviour=BEHAVIOUR,
    jobs=("propagate", "start", "carry", "update"),
    order="before",
    template="clone.c",
    texts={
        **TEXTS,
        "start.k": "filter.j",
        "clone": "&filter_clone",
        "Phi": "Phi",
        "W": "filter.W",
        "W_next": "filter_W[filter.slot]",
        "z": "filter_z",
    },
    memory=_memory,
    fields="    int now; /* which of the estimates in memory */\n"
    "    bool taken; /* whether a measurement is on its way */\n"
    "    int slot; /* the W in memory that was filled last */\n"
    "    real (*W)[$p]; /* of k, carried to j */\n",
    start="    filter.now = 0;\n    filter.taken = false;\n    filter.slot = 0;\n",
    takes=True,
    words=lambda _wanted, _steps: {"to_H": "(void)"},
)
CLONE_SPLIT = CLONE._replace(
    title="filter by stochastic cloning, its work divided between k and m",
    texts={**CLONE.texts, "update.k": "filter.k", "H": "filter.H"},
    fields=f"{CLONE.fields}    int k; /* at which it was taken */\n    real (*H)[$n]; /* H_k */\n",
    words=lambda _wanted, _steps: {"to_H": "filter.k = filter.j;\n    filter.H = "},
)


def _more(wanted: Filter) -> Mapping[str, Job]:
    form = covariance_form(wanted.update)
    return as_jobs(wanted, form, ("cross", cross, start_arguments), ("divide", divide, _divide))


def _divide(system: System, form: Any, at: Sample) -> tuple[Any, ...]:
    H, clone, _ = sampled(system, at)
    return system, form, at.k, H, clone, new_workspace(system)


def _memory_in_flight(parts: Parts) -> None:
    n, p, flights = parts.system.states, parts.system.measurements, in_flight(parts.steps)
    add_arrays(parts, x=(2, n), P=(2, n, n), expected=(flights, 2, p), W=(flights, 2, n, p))
    add_arrays(parts, S=(flights, p, p), factor=(flights, p, p), G=(flights, flights, p, p), z=(p,))


CLONE_IN_FLIGHT = CLONE._replace(
    title="filter by stochastic cloning, with several measurements on their way",
    jobs=("propagate", "start", "carry", "update", "couple", "compensate"),
    template="clone_in_flight.c",
    texts={
        **TEXTS,
        "k": "filter.j",
        "Phi": "Phi",
        "carry.W": "filter_W[f][filter.W[f]]",
        "W_next": "filter_W[f][other]",
        "cross.clone": "&clone",
        "H": "H",
        "earlier": "&earlier",
        "W_earlier": "filter_W[f][filter.W[f]]",
        "couple.W": "filter_W[taken][filter.W[taken]]",
        "W_apart": "filter_W[taken][other]",
        "G": "filter_G[taken][f]",
        "divide.clone": "&apart",
        "update.clone": "&landed",
        "update.W": "filter_W[f][filter.W[f]]",
        "z": "filter_z",
        "expected": "filter_expected[later][filter.expected[later]]",
        "C": "filter_G[later][f]",
        "now_expected": "filter_expected[later][other]",
    },
    memory=_memory_in_flight,
    fields="    int now; /* which of the estimates in memory */\n"
    "    int first; /* of the measurements on their way */\n"
    "    int count;\n"
    "    int W[$in_flight]; /* which of two is that of now */\n"
    "    int expected[$in_flight];\n",
    start="    filter.now = 0;\n    filter.first = 0;\n    filter.count = 0;\n",
    more=_more,
)
