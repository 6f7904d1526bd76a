"""Methods that are written step by step leave the bits of their `run`, also where several measurements are on their way
and where one is lost."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.covariance_forms import CovarianceFormName
from filters.registry import ALL_METHODS, MULTIRATE_METHODS
from filters.system import System
from filters.systems.example import example_system
from filters.systems.navigation import vehicle
from studies.board.record import simulated
from studies.board.serial.methods import IN_FLIGHT, SERIAL, serial
from studies.board.steps import Steps
from studies.board.wanted import Filter
from tests.studies.board.build import HERE, build, needs_gcc, put, ran, ran_as_one, written
from tests.studies.board.systems import pendulum, unchanging

pytestmark = needs_gcc
DRIVING = np.array([0.0, 0.0, 0.5, 15.0, 0.0, 0.0])
STEPS = {
    "standard": [Steps(3, 0, 0)],
    "recalculate": [Steps(6, 5, 5), Steps(3, 8, 8)],
    "larsen": [Steps(6, 4, 4), Steps(3, 8, 8)],
    "clone": [Steps(6, 4, 4), Steps(3, 8, 8)],
    "clone-split": [Steps(6, 4, 4)],
    "carried-gain": [Steps(6, 4, 4), Steps(3, 8, 8)],
    "delayed-horizon": [Steps(6, 3, 5)],
    "px4-predictor": [Steps(6, 3, 3)],
    "augmentation": [Steps(6, 3, 3)],
    "fuse-as-fresh": [Steps(6, 4, 4)],
    "multirate": [Steps(4, 0, 2)],
    "multirate-square-root": [Steps(4, 0, 2)],
    "multirate-ud": [Steps(4, 0, 2)],
}
LIKE_OTHERS = ("fuse-as-fresh", "multirate-square-root")
"""Those that have the steps of another method."""
AT_THE_EDGE = {
    "standard": [Steps(1, 0, 0)],
    "multirate": [Steps(4, 0, 0), Steps(4, 0, 4), Steps(1, 0, 0)],
    "delayed-horizon": [Steps(6, 0, 1), Steps(6, 3, 6), Steps(1, 0, 1)],
    **{
        method: [Steps(5, 1, 1), Steps(5, 5, 5), *([Steps(4, 8, 8), Steps(1, 3, 3)] if method in IN_FLIGHT else [])]
        for method in ("recalculate", "larsen", "clone", "clone-split", "carried-gain", "px4-predictor", "augmentation")
    },
}


LOST = ("clone", "carried-gain")


def systems(method: str) -> list[tuple[System, FloatArray]]:
    """With states to start from."""
    if method in MULTIRATE_METHODS:
        return [(unchanging(), np.zeros(3))]
    return [(pendulum(), np.array([0.1, 0.0])), (example_system(4, 2, 2), np.zeros(4)), (vehicle(), DRIVING)]


def cases() -> list[Any]:
    """Those at the edge, and larger systems, take too long for each time."""
    return [
        pytest.param(
            method,
            steps,
            number,
            id=f"{method}-{'-'.join(map(str, steps))}-{number}",
            marks=() if number == 0 and steps in STEPS[method] and method not in LIKE_OTHERS else pytest.mark.exhaust,
        )
        for method in STEPS
        for steps in (*STEPS[method], *AT_THE_EDGE.get(method, []))
        for number in range(len(systems(method)))
    ]


@pytest.mark.parametrize(("method", "steps", "number"), cases())
def test_whole_runs_give_the_bits_of_python(method: str, steps: Steps, number: int, tmp_path: Path) -> None:
    system, x0 = systems(method)[number]
    put(tmp_path, written(system, method=method, x0=x0, update="short", steps=steps))
    status, said = ran_as_one(tmp_path, "filter.c", "steps.c", "test.c", options=["-DTOLERANCE=0"])
    assert status == 0, said
    assert "# steps                   the same bits" in said


@pytest.mark.exhaust
@pytest.mark.parametrize("update", ["textbook", "joseph"])
@pytest.mark.parametrize("method", STEPS)
def test_other_covariance_updates(method: str, update: CovarianceFormName, tmp_path: Path) -> None:
    system, x0 = systems(method)[0]
    for number, steps in enumerate(STEPS[method]):
        folder = tmp_path / str(number)
        folder.mkdir()
        put(folder, written(system, method=method, x0=x0, update=update, steps=steps))
        status, said = ran_as_one(folder, "filter.c", "steps.c", "test.c", options=["-DTOLERANCE=0"])
        assert status == 0, said


@pytest.mark.exhaust
@pytest.mark.parametrize(
    ("method", "steps"),
    [(method, steps) for method, several in STEPS.items() for steps in several]
    + [("dual-rate", Steps(*steps)) for steps in ((10, 4, 8), (4, 0, 4), (5, 8, 12), (1, 2, 3))],
)
def test_nothing_beyond_an_array_is_read_or_written(method: str, steps: Steps, tmp_path: Path) -> None:
    system, x0 = systems(method)[0]
    files = written(system, method=method, x0=x0, steps=steps)
    put(tmp_path, files)
    sources = [name for name in ("filter.c", "tasks.c", "steps.c", "test.c") if name in files]
    watched = ["-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover"]
    build(tmp_path, *watched, *sources, "-lm", "-o", "test")
    status, said = ran(tmp_path, "test")
    assert status == 0, said


@pytest.mark.exhaust
@pytest.mark.parametrize("method", STEPS)
def test_in_single_precision(method: str, tmp_path: Path) -> None:
    system, x0 = systems(method)[0]
    put(tmp_path, written(system, method=method, x0=x0, precision="single", steps=STEPS[method][0]))
    build(tmp_path, "-O2", "filter.c", "steps.c", "test.c", "-lm", "-o", "test")
    status, said = ran(tmp_path, "test")
    assert status == 0, said


@pytest.mark.parametrize(
    ("method", "steps"),
    [
        pytest.param(method, steps, marks=() if steps.M > steps.N and method in LOST else pytest.mark.exhaust)
        for method in STEPS
        for steps in STEPS[method]
    ],
)
def test_a_measurement_that_is_lost(method: str, steps: Steps, tmp_path: Path) -> None:
    """Where that must be known at k it is not taken, elsewhere it does not arrive."""
    system, x0 = systems(method)[0]
    put(tmp_path, written(system, method=method, x0=x0, steps=steps))
    shutil.copy(HERE / "lost.c", tmp_path)
    how = serial(method, steps)
    options = [f"-D{how.order.upper()}", *(["-DTAKES"] if how.takes else [])]
    status, said = ran_as_one(tmp_path, "filter.c", "steps.c", "lost.c", options=options)
    assert status == 0
    record = simulated(Filter(method, system, x0, "textbook", "double", steps, ""), steps)
    y = [None if c == 1 else row for c, row in enumerate(record.y)]
    of_steps = (steps.N,) if how.order == "each" else steps
    more = {"L": steps.L} if how.order == "each" else {}
    expected = ALL_METHODS[method].run(system, *of_steps, record.x0, record.P0, record.u, y, **more).x[-1]
    found = np.array([float.fromhex(number) for number in said.split()])
    np.testing.assert_allclose(found, expected, rtol=1e-13, atol=1e-13)


def test_all_methods_are_written() -> None:
    assert {"dual-rate", *SERIAL} == set(ALL_METHODS)
    assert set(STEPS) == set(SERIAL)
