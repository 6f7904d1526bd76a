"""What the report on accuracy asks of the studies. No graphics."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from studies.accuracy.approximations import Approximations, approximations, noise_by_camera_rate, noise_of_camera
from studies.accuracy.given import MODELS, given
from studies.accuracy.landing import Landing, landing
from studies.accuracy.scale import Placed, counted, scale
from studies.accuracy.slow_processor import Choice, choices

EXAMPLE = "ins-gps"
"""The model in whose example all methods stand on one scale: N=80, M=44."""

Progress = Callable[[int, int, str], None]


class Results(NamedTuple):
    """By model. noise_by_rate: of the camera, by its rate in Hz, what Q' costs landing at L = N; noise_on_arrival:
    at 2 Hz and L = M. choices: on the slow processor."""

    landings: Mapping[str, Landing]
    approximations: Mapping[str, Approximations]
    placed: Mapping[str, Sequence[Placed]]
    noise_by_rate: Mapping[int, float]
    noise_on_arrival: float
    choices: Sequence[Choice]


def results(progress: Progress = lambda _done, _total, _what: None) -> Results:
    """Runs the studies: some 15 seconds."""
    landings, approximated, placed = {}, {}, {}
    for done, name in enumerate(MODELS):
        progress(done, len(MODELS), name)
        of = given(name)
        landings[name] = landing(of)
        approximated[name] = approximations(of)
        placed[name] = scale(of, counted(of), approximated[name].px4)
    progress(len(MODELS), len(MODELS), "done")
    camera = given("camera")
    on_arrival = noise_of_camera(round(camera.hr_hz / 2), camera.M)
    return Results(landings, approximated, placed, noise_by_camera_rate(), on_arrival, choices())
