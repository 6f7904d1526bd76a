"""What compiling gains a whole filter: the rocket's, on the beginning of a flight, as it is written in Python, with
NumPy calls in place of its loops over matrices, and compiled.

All run the same code on the same measurements, late ones recalculated, one after another in each round. The time is
that of a call of `filters.modular.run`, checks and the sorting of measurements included, compiling not.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from time import thread_time_ns
from typing import get_args

import numpy as np

from filters.backends.choose import BackendName
from filters.modular import run
from filters.systems.rocket import RATE_HZ
from filters.systems.rocket_filter import OF, PredictorName, rocket_filter, start
from studies.measurement.busy import clocks, load, signs_of_others
from studies.measurement.job_times import Progress, Protocol, check_compiles, no_garbage_collection, silent
from studies.measurement.methods import where_timed
from studies.modular.costs import Times
from studies.modular.rocket_flights import flight, measure

NAME = "modular-flight"
"""What its measurements are called where they are kept."""
PREDICTORS: tuple[PredictorName, ...] = get_args(PredictorName)
WAYS: tuple[BackendName, ...] = ("reference", "numpy", "compiled")
STATES = str(OF.errors)
FLOWN_S, SEED = 3, 0
"""So much of the flight of this seed, a second on the pad included."""
PROTOCOL = Protocol(rounds=3, repetitions=1)


def flight_times(steps: int = FLOWN_S * RATE_HZ, protocol: Protocol = PROTOCOL, progress: Progress = silent) -> Times:
    """By kind of the predictor, states and way, in that order; half a minute.

    Raises InputError where numba compiles nothing.
    """
    check_compiles()
    before = load()
    runs = {(kind, STATES, way): _run(kind, way, steps) for kind in PREDICTORS for way in WAYS}
    for (_, _, way), fly in runs.items():
        if way == "compiled":
            fly()
    found: dict[tuple[str, str, str], list[int]] = {key: [] for key in runs}
    begun = clocks()
    with no_garbage_collection():
        for done in range(protocol.rounds):
            progress(done, protocol.rounds, "timing flights")
            for key, fly in runs.items():
                at = thread_time_ns()
                for _ in range(protocol.repetitions):
                    fly()
                found[key].append(thread_time_ns() - at)
    progress(protocol.rounds, protocol.rounds, "timed flights")
    about = where_timed(protocol, SEED, signs_of_others(before, begun, clocks(), found.values()))
    protocol_of_it = {**protocol._asdict(), "steps": steps, "seed": SEED}
    scale = 1e9 * protocol.repetitions
    seconds = {key: [time / scale for time in times] for key, times in found.items()}
    return Times(seconds, {**about, "protocol": protocol_of_it})


def _run(kind: PredictorName, way: BackendName, steps: int) -> Callable[[], object]:
    truth = flight(SEED).states[: steps + 1]
    x0, P0 = start(truth[0], SEED)
    return partial(run, rocket_filter(kind), x0, P0, np.zeros((steps, 0)), measure(0.0, SEED, truth), backend=way)
