"""Runs of the two tasks in C, LR preempted by HR wherever it can be, leave the bits of `dual_rate.run`."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from filters.covariance_forms import CovarianceFormName
from filters.delayed import dual_rate
from filters.system import System
from filters.systems.example import example_system
from filters.systems.navigation import vehicle
from studies.board.record import simulated
from studies.board.steps import Steps
from studies.board.wanted import Filter
from tests.studies.board.build import HERE, build, needs_gcc, put, ran, written
from tests.studies.board.systems import pendulum

pytestmark = needs_gcc
SYSTEMS = {"linear": example_system(4, 2, 2), "vehicle": vehicle(), "scratch": pendulum()}
STEPS = [Steps(10, 4, 8), Steps(10, 4, 10), Steps(10, 4, 5), Steps(5, 0, 1), Steps(2, 1, 2), Steps(6, 5, 6)]
IN_FLIGHT = [
    Steps(5, 8, 12),
    Steps(5, 5, 6),
    Steps(5, 2, 6),
    Steps(5, 5, 10),
    Steps(3, 8, 12),
    Steps(4, 3, 8),
    Steps(1, 2, 3),
]
"""Where several corrections are on their way at once."""


def preempted(folder: Path, files: dict[str, str]) -> tuple[int, str]:
    """What the harness says."""
    put(folder, files)
    shutil.copy(HERE / "preempted.c", folder)
    build(folder, "-O0", "-finstrument-functions", "-c", "filter.c", "tasks.c")
    build(folder, "-O0", "filter.o", "tasks.o", "preempted.c", "-lm", "-o", "preempted")
    return ran(folder, "preempted")


@pytest.mark.parametrize(
    ("name", "steps"),
    [
        pytest.param(name, steps, marks=() if (name == "linear") != (steps == STEPS[0]) else pytest.mark.exhaust)
        for name in SYSTEMS
        for steps in STEPS
    ],
)
def test_low_rate_jobs_that_are_preempted_anywhere(name: str, steps: Steps, tmp_path: Path) -> None:
    status, said = preempted(tmp_path, written(SYSTEMS[name], steps=steps))
    assert status == 0, said
    assert " 0 wrong, none skipped" in said
    assert int(said.split()[0]) > 30  # places within the jobs


@pytest.mark.parametrize(
    ("name", "steps"),
    [
        pytest.param(name, steps, marks=() if name == "scratch" and steps in IN_FLIGHT[:2] else pytest.mark.exhaust)
        for name in SYSTEMS
        for steps in IN_FLIGHT
    ],
)
def test_several_corrections_on_their_way(name: str, steps: Steps, tmp_path: Path) -> None:
    files = written(SYSTEMS[name], steps=steps)
    status, said = preempted(tmp_path, files)
    assert status == 0, said
    assert " 0 wrong, none skipped" in said
    build(tmp_path, "-I", str(HERE / "stubs"), "-c", "freertos.c")


@pytest.mark.parametrize("update", ["short", pytest.param("joseph", marks=pytest.mark.exhaust)])
def test_other_covariance_updates(update: CovarianceFormName, tmp_path: Path) -> None:
    status, said = preempted(tmp_path, written(SYSTEMS["linear"], update=update, steps=STEPS[0]))
    assert status == 0, said


@pytest.mark.parametrize("choice", [{"gain": "precomputed"}, {"low_rate_noise": "sum"}], ids=str)
def test_other_choices(choice: dict[str, Any], tmp_path: Path) -> None:
    """With the gain computed at k, and with the noise only summed."""
    status, said = preempted(tmp_path, written(SYSTEMS["scratch"], steps=STEPS[0], **choice))
    assert status == 0, said


TWO_IN_TURN = "tasks.c", [("slot == here || slot == in_message", "slot == here || in_message < NONE")]
ONE_WORKSPACE = "state.h", [("static real lr_work_nn1[4][4];\n", ""), ("lr_work_nn1", "hr_work_nn1")]


@pytest.mark.parametrize(("file", "changes"), [TWO_IN_TURN, ONE_WORKSPACE], ids=["two in turn", "one workspace"])
def test_what_was_shared_would_be_seen(file: str, changes: list[tuple[str, str]], tmp_path: Path) -> None:
    files = written(SYSTEMS["linear"], steps=STEPS[0])
    for here, instead in changes:
        assert here in files[file]
        files[file] = files[file].replace(here, instead)
    status, said = preempted(tmp_path, files)
    assert status == 1, said


@pytest.mark.exhaust
def test_fewer_slots_would_be_seen(tmp_path: Path) -> None:
    files = written(SYSTEMS["scratch"], steps=IN_FLIGHT[0])
    files["tasks.h"] = files["tasks.h"].replace("SLOTS = 6", "SLOTS = 2")
    files["tasks.c"] = files["tasks.c"].replace("sent - needed < SLOTS", "sent - needed < 6u")
    status, said = preempted(tmp_path, files)
    assert status == 1, said


def test_scratch_of_a_model_is_each_tasks_own() -> None:
    state = written(SYSTEMS["scratch"], steps=STEPS[0])["state.h"]
    for array in ("hr_scratch_F", "lr_scratch_H"):
        assert f"static real {array}" in state
    assert state.count("static const real model_Q") == 1


@pytest.mark.parametrize("which", ["LOST", "LATE"])
@pytest.mark.parametrize("name", SYSTEMS)
def test_a_measurement_that_is_lost_or_left_out(name: str, which: str, tmp_path: Path) -> None:
    """Left out, because the correction before it was late, it counts as lost; but Phi goes on over two cycles, and the
    correction lands in a step of its own, so that a nonlinear filter linearises elsewhere."""
    system, steps = SYSTEMS[name], Steps(8, 3, 5)
    put(tmp_path, written(system, steps=steps))
    shutil.copy(HERE / "late.c", tmp_path)
    build(tmp_path, f"-D{which}", "filter.c", "tasks.c", "late.c", "-lm", "-o", "late")
    status, said = ran(tmp_path, "late")
    skipped, *numbers = said.split()
    x = np.array([float.fromhex(number) for number in numbers])
    record = simulated(Filter("dual-rate", system, np.zeros(system.states), "textbook", "double", steps, ""), steps)
    y = [record.y[0], None, record.y[2]]
    expected = dual_rate.run(system, *steps, record.x0, record.P0, record.u, y).x[-1]
    assert status == 0
    assert (skipped == "1") == (which == "LATE")
    if which == "LOST":
        np.testing.assert_array_equal(x, expected)
    elif name == "linear":
        np.testing.assert_allclose(x, expected, rtol=1e-12, atol=1e-12)


def test_the_record_is_what_the_system_makes() -> None:
    system: System = SYSTEMS["linear"]
    record = simulated(Filter("dual-rate", system, np.zeros(4), "textbook", "double", STEPS[0], ""), STEPS[0])
    assert [len(values) for values in record] == [4, 4, 28, 3, 29]
    assert np.isfinite(record.x).all()
