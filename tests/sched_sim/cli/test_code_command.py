"""`sched-sim code`: what it writes, and what it refuses."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.command_line import Run, is_refused

MODEL = """
import numpy as np
from filters import System

def f(j, x, u, p, out):
    out[0] = x[0] + u[0]

def F(j, x, u, p):
    return {F}

def h(k, x, p, out):
    out[0] = x[0]

def H(k, x, p):
    return np.array([[1.0]])

def Q(j, p):
    return np.array([[0.1]])

def R(k, p):
    return np.array([[{R}]])

def system():
    return System(1, 1, 1, f, F, Q, h, H, R, ())
"""


COMPOSED = """
from filters.modular import ModularFilter, Sensor, linear_corrector, linear_predictor

def made():
    gps = Sensor("gps", linear_corrector([[1.0]], [[0.1]]), delay=2)
    return ModularFilter(linear_predictor([[1.0]], [[0.1]]), [gps])
"""


def write_model(F: str = "np.array([[1.0]])", R: str = "1.0") -> None:
    Path("own.py").write_text(MODEL.replace("{F}", F).replace("{R}", R))


def test_the_two_tasks_are_written_and_said(sched_sim: Run) -> None:
    result = sched_sim("code --states 3 --inputs 1 --measurements 1 --precision single -N 8 -M 2 -o new/board")
    assert result.code == 0
    assert result.out == ""
    assert "Wrote new/board: filter.h, filter.c, tasks.h" in result.err
    assert "Written for -N 8 -M 2 -L 3" in result.err
    folder = Path("new/board")
    assert "CYCLE_STEPS = 8, DELAY_STEPS = 2, LANDING_STEPS = 3" in (folder / "tasks.h").read_text()
    assert "typedef float real;" in (folder / "filter.h").read_text()
    assert (
        "--states 3 --inputs 1 --measurements 1 --update textbook --precision single -N 8 -M 2 -L 3"
        in (folder / "README.md").read_text()
    )
    assert "(16)" in (folder / "filter.c").read_text()


def test_files_of_another_method_are_not_left_behind(sched_sim: Run) -> None:
    sizes = "--states 2 --inputs 1 --measurements 1 -o board"
    assert sched_sim(f"code {sizes}").code == 0
    written = {"filter.h", "filter.c", "state.h", "test.c", "README.md"}
    assert "Its jobs alone: a model over N steps" in sched_sim(f"code --method multirate {sizes}").err
    assert {path.name for path in Path("board").iterdir()} == written
    assert sched_sim(f"code --method larsen -N 6 -M 2 {sizes}").code == 0
    assert {path.name for path in Path("board").iterdir()} == written | {"steps.h", "steps.c", "record.h"}
    assert "-N 6 -M 2 -o FOLDER" in Path("board/README.md").read_text()


def test_a_model_of_ones_own(sched_sim: Run) -> None:
    write_model()
    assert sched_sim("code --system own:system --update short -o board").code == 0
    assert "own_F" in Path("board/filter.c").read_text()


def test_robust_and_composed_filters(sched_sim: Run) -> None:
    assert "Written for -N 5" in sched_sim("code --robust attitude -N 5 -o robust").err
    assert "robust-closed" in Path("robust/README.md").read_text()
    Path("composed.py").write_text(COMPOSED)
    result = sched_sim("code --filter composed:made --precision single -o composed")
    assert "the steps since done again" in result.err
    assert "void filter_measure_gps(int taken, real y[1]);" in Path("composed/steps.h").read_text()


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("code -o board --precision half", ["--precision", "half", "single", "double"]),
        ("code -o board --method larson", ["--method 'larson'", "did you mean larsen?"]),
        ("code -o board --method robust-lu", ["--method 'robust-lu' is unknown here"]),
        ("code -o board -N 1 -M 0", ["-N 1", "at least 2"]),
        ("code -o board -N 10 -M -1", ["-M -1 must be 0 or more: it is the delay"]),
        ("code -o board -N 10 -M 4 -L 4", ["-L 4 must be more than -M 4: as C the correction lands behind"]),
        ("code -o board -N 10 -M 12 -L 12", ["-L 12 must be more than -M 12"]),
        ("code -o board -N 10 -M 12 --gain precomputed", ["--gain precomputed is not written as C", "-M less than -N"]),
        ("code -o board -N 2 -M 129", ["-M 129 is too large: give at most 128", "64 measurements"]),
        ("code -o board --method clone -N 10 -L 5", ["--method clone: leave out -L", "in the step in which"]),
        (
            "code -o board --method clone-split -N 10 -M 11",
            ["-M 11 must be from 1 to 10", "choose --method recalculate"],
        ),
        ("code -o board --method clone -M 1001", ["-M 1001 is too large"]),
        ("code -o board --method multirate -M 3", ["--method multirate: leave out -M", "in every step"]),
        ("code -o board --method multirate -N 5", ["-N 5", "linear_system whose Phi and Q do not change", "-N 1"]),
        ("code -o board --method multirate -N 1 -L 2", ["-L 2 must be from 0 to 1"]),
        ("code -o board --method delayed-horizon -N 5 -M 3 -L 3", ["-L 3 must be from 4 to 5"]),
        ("code -o board --method delayed-horizon -N 5 -M 5", ["-M 5 must be from 0 to 4"]),
        ("code -o board --method larsen -N 10 -L 5", ["--method larsen: leave out -L", "in the step in which"]),
        ("code -o board --method standard -M 3", ["--method standard: leave out -M"]),
        ("code -o board --method larsen -M 0", ["-M 0 must be at least 1", "--method standard"]),
        ("code -o board --system own:system --states 3", ["leave out --states"]),
        ("code -o board --filter own:system --states 3 -N 4", ["--filter own:system: leave out --states, -N"]),
        ("code -o board --filter own:system", ["--filter 'own:system'", "returns a filters.modular.ModularFilter"]),
        ("code -o board --robust speed", ["--robust", "speed", "attitude", "position"]),
        ("code -o board --robust attitude -M 3", ["--robust attitude: leave out -M", "a system of its own"]),
        ("code -o board --robust attitude --method larsen", ["--method 'larsen' is unknown here", "robust-givens"]),
        ("code -o board --robust attitude -N 0", ["-N 0 must be at least 1"]),
        ("code -o board --states 65", ["--states 65", "at most 64"]),
        ("code -o board -N 1001 -M 4", ["-N 1001", "at most 1000", "CYCLE_STEPS"]),
        ("code -o board --low-rate-noise euler", ["--low-rate-noise euler is not written as C", "exact or sum"]),
        ("code -o board --method larsen --gain precomputed", ["leave out --gain", "--method dual-rate"]),
        ("code -o own.py", ["--output 'own.py' is a file"]),
        ("code -o full", ["--output 'full' holds a.txt, b.txt, c.txt and 1 more"]),
        ("code -o own.py/board", ["own.py/board", "cannot be"]),
        ("code", ["--output"]),
        ("code -o board --system own:nothing", ["own", "has no function 'nothing'"]),
    ],
)
def test_what_is_refused(line: str, said: list[str], sched_sim: Run) -> None:
    write_model()
    Path("full").mkdir()
    for name in "abcd":
        Path(f"full/{name}.txt").touch()
    is_refused(sched_sim(line), said)
    assert not Path("board").exists()


@pytest.mark.parametrize(
    ("change", "options", "said"),
    [
        ({"F": "np.linalg.inv(np.array([[1.0]]))"}, "", ["own.py:9", "np.linalg.inv", "not translated"]),
        ({"R": "1e-60 + 1.0"}, "--precision single", ["own.py:21", "single precision has no 1e-60"]),
    ],
)
def test_a_model_that_is_not_translated(change: dict[str, str], options: str, said: list[str], sched_sim: Run) -> None:
    write_model(**change)
    is_refused(sched_sim(f"code --system own:system {options} -o board"), said)
    assert not Path("board").exists()
