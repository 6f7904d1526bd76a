"""The carried gain: P is corrected at k, and the gain is carried to m."""

from __future__ import annotations

from filters.delayed.carried_gain import new_flight
from studies.board.serial.method import TEXTS, Parts, Serial, add_arrays, add_record, in_flight


def _memory(parts: Parts) -> None:
    n, p = parts.system.states, parts.system.measurements
    add_arrays(parts, x=(2, n), P=(2, n, n), B=(2, n, p), z=(p,))
    add_record(parts, "flight", new_flight(parts.system), parts.in_c.parameter("update", "flight"))


CARRIED_GAIN = Serial(
    title="filter with a carried gain",
    behaviour="P is corrected at k, x at m, before that step, by the gain of k that is carried there.",
    jobs=("propagate", "update", "carry", "land"),
    order="before",
    template="carried_gain.c",
    texts={
        **TEXTS,
        "k": "filter.j",
        "P_posterior": "filter_P[P_next]",
        "flight": "&filter_flight",
        "Phi": "Phi",
        "W": "filter.B",
        "W_next": "filter_B[filter.slot]",
        "expected": "filter_flight_expected",
        "B": "filter.B",
        "x": "filter_x[filter.x]",
        "x_corrected": "filter_x[x_next]",
        "z": "filter_z",
    },
    memory=_memory,
    fields="    int x; /* which of the estimates in memory */\n"
    "    int P;\n"
    "    bool taken; /* whether a measurement is on its way */\n"
    "    int slot; /* the B in memory that was filled last */\n"
    "    real (*B)[$p]; /* the gain of k, carried to j */\n",
    start="    filter.x = 0;\n    filter.P = 0;\n    filter.taken = false;\n    filter.slot = 0;\n",
    now="filter_x[filter.x]",
    takes=True,
)


def _memory_in_flight(parts: Parts) -> None:
    n, p, flights = parts.system.states, parts.system.measurements, in_flight(parts.steps)
    add_arrays(parts, x=(2, n), P=(2, n, n), expected=(flights, 2, p), B=(flights, 2, n, p))
    add_arrays(parts, C=(flights, flights, p, p), S=(p, p), z=(p,))


CARRIED_GAIN_IN_FLIGHT = CARRIED_GAIN._replace(
    title="filter with carried gains, of several measurements on their way",
    jobs=("propagate", "update", "carry", "land", "couple", "compensate"),
    template="carried_gain_in_flight.c",
    texts={
        **CARRIED_GAIN.texts,
        "flight": "&flown",
        "W": "filter_B[f][filter.B[f]]",
        "W_next": "filter_B[f][other]",
        "H": "H",
        "B": "filter_B[f][filter.B[f]]",
        "couple.C": "filter_C[taken][f]",
        "land.expected": "filter_expected[f][filter.expected[f]]",
        "compensate.expected": "filter_expected[later][filter.expected[later]]",
        "compensate.C": "filter_C[later][f]",
        "now_expected": "filter_expected[later][other]",
    },
    memory=_memory_in_flight,
    fields="    int x; /* which of the estimates in memory */\n"
    "    int P;\n"
    "    int first; /* of the measurements on their way */\n"
    "    int count;\n"
    "    int B[$in_flight]; /* which of two is that of now */\n"
    "    int expected[$in_flight];\n",
    start="    filter.x = 0;\n    filter.P = 0;\n    filter.first = 0;\n    filter.count = 0;\n",
)
