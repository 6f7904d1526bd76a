"""Larsen's method: the correction of k is carried to m by Phi_{k->m}."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from filters.covariance_forms import covariance_form
from filters.jobs import Job
from studies.board.serial.method import TEXTS, Parts, Serial, add_arrays, add_correction, as_jobs, in_flight
from studies.board.wanted import Filter


def _memory(parts: Parts) -> None:
    n = parts.system.states
    add_arrays(parts, x=(3, n), P=(3, n, n), Phi=(2, n, n))
    add_correction(parts, "update")


LARSEN = Serial(
    title="filter by Larsen's method",
    behaviour="A late measurement is used at m, with Phi from k to m (Eqs. 20, 21).",
    jobs=("propagate", "propagate_accumulate", "update"),
    order="after",
    template="larsen.c",
    texts={
        **TEXTS,
        "k": "filter.j - DELAY_STEPS",
        "Phi_from_k": "filter.Phi",
        "Phi_next": "filter_Phi[filter.slot]",
    },
    memory=_memory,
    fields="    int now; /* which of the estimates in memory */\n"
    "    int reference; /* that of k */\n"
    "    int slot; /* the Phi in memory that was filled last */\n"
    "    real (*Phi)[$n]; /* from k to j */\n",
    start="    filter.now = 0;\n    filter.reference = 0;\n    filter.slot = 0;\n",
)


def _more(wanted: Filter) -> Mapping[str, Job]:
    form = covariance_form(wanted.update)
    return as_jobs(
        wanted,
        form,
        ("product", form.product, lambda _system, _form, at: (*2 * (at.transition.Phi,), np.zeros_like(at.now.P))),
    )


def _memory_in_flight(parts: Parts) -> None:
    n, p, flights = parts.system.states, parts.system.measurements, in_flight(parts.steps)
    add_arrays(parts, x=(2, n), P=(2, n, n), x_at_k=(flights, 2, n), K=(flights, n, p))
    add_arrays(parts, Phi=(flights, 2, n, n), Phi_at=(flights, flights, n, n), z=(p,), delta_x=(n,))


LARSEN_IN_FLIGHT = Serial(
    title="filter by Larsen's method, with several measurements on their way",
    behaviour="P is corrected at k, and x at m, with Phi from k to m.",
    jobs=("propagate", "propagate_accumulate", "update", "gain", "correct", "compensate"),
    order="after",
    template="larsen_in_flight.c",
    texts={
        **TEXTS,
        "A": "Phi",
        "B": "filter_Phi[f][filter.Phi[f]]",
        "out": "filter_Phi[f][other]",
        "gain.k": "filter.j",
        "P_posterior": "filter_P[P_next]",
        "correction": "&correction",
        "correct.k": "filter.k[f]",
        "correct.x_reference": "filter_x_at_k[f][filter.x_at_k[f]]",
        "correct.Phi_from_k": "filter_Phi[f][filter.Phi[f]]",
        "correct.x": "filter_x[filter.x]",
        "correct.x_corrected": "filter_x[x_next]",
        "compensate.x": "filter_x_at_k[later][filter.x_at_k[later]]",
        "compensate.Phi_from_k": "filter_Phi_at[f][later]",
        "compensate.delta_x": "filter_delta_x",
        "compensate.x_corrected": "filter_x_at_k[later][other]",
    },
    memory=_memory_in_flight,
    fields="    int x; /* which of the estimates in memory */\n"
    "    int P;\n"
    "    int first; /* of the measurements on their way */\n"
    "    int count;\n"
    "    int k[$in_flight];\n"
    "    int x_at_k[$in_flight]; /* which of two is x_{k^-}, with what has landed since */\n"
    "    int Phi[$in_flight]; /* which of two is that from k to j */\n",
    start="    filter.x = 0;\n    filter.P = 0;\n    filter.first = 0;\n    filter.count = 0;\n",
    now="filter_x[filter.x]",
    takes=True,
    more=_more,
)
