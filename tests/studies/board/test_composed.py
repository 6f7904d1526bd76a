"""Composed filters leave the bits of `filters.modular.run`, with measurements that come late, out of order, or not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from filters.modular import ModularFilter, Sensor, extended_corrector, extended_predictor, linear_corrector
from filters.translation.library import Precision
from sched_sim.costs.sample_file import read_sampled_costs
from studies.board.composed.files import composed_files
from studies.board.composed.wanted import Composed
from tests.filters.modular.cases import CASES, Case, linear_case
from tests.studies.board.build import build, needs_gcc, put, ran, ran_as_one, without_sizes


def files_of(name: str, case: Case, precision: Precision = "double") -> dict[str, str]:
    with without_sizes():
        return composed_files(Composed(name, *case, precision, "sched-sim code"))


@needs_gcc
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name == "attitude" else pytest.mark.exhaust) for name in CASES]
)
def test_whole_runs_give_the_bits_of_python(name: str, tmp_path: Path) -> None:
    """Sines of the C library may differ from NumPy's in the last bit."""
    put(tmp_path, files_of(name, CASES[name]))
    status, said = ran_as_one(tmp_path, "filter.c", "steps.c", "test.c")
    assert status == 0, said
    assert "off" not in said or name != "linear"


@needs_gcc
@pytest.mark.exhaust
@pytest.mark.parametrize("name", ["linear", "unscented"])
def test_in_single_precision(name: str, tmp_path: Path) -> None:
    put(tmp_path, files_of(name, CASES[name], "single"))
    build(tmp_path, "-O2", "filter.c", "steps.c", "test.c", "-lm", "-o", "test")
    status, said = ran(tmp_path, "test")
    assert status == 0, said


@needs_gcc
@pytest.mark.parametrize("update", ["short", pytest.param("joseph", marks=pytest.mark.exhaust), "u-d"])
def test_factors_are_kept_where_the_filter_keeps_them(update: str, tmp_path: Path) -> None:
    composed = CASES["linear"].composed
    composed = ModularFilter(composed.predictor, composed.sensors, composed.dt, composed.of, update=update)
    put(tmp_path, files_of("linear", CASES["linear"]._replace(composed=composed)))
    status, said = ran_as_one(tmp_path, "filter.c", "steps.c", "test.c", options=["-DTOLERANCE=0"])
    assert status == 0, said
    assert "# steps                   the same bits" in said


@needs_gcc
def test_names_that_c_has_not_and_their_samples(tmp_path: Path) -> None:
    position = linear_corrector(np.array([[1.0, 0.0]]), np.array([[0.2]]))
    sensors = Sensor("a b", position, delay=2), Sensor("a_b", position), Sensor("für */", position, every=2)
    put(tmp_path, files_of("named", linear_case(*sensors)))
    clock = ["-DCYCLES=clock()", "-DCLOCK_HZ=CLOCKS_PER_SEC", "-include", "time.h"]
    status, said = ran_as_one(tmp_path, "filter.c", "steps.c", "test.c", options=["-DTOLERANCE=0", *clock])
    assert status == 0, said
    (tmp_path / "samples.toml").write_text(said.replace("[0.0000]", "[0.0001]"))
    samples = read_sampled_costs(tmp_path / "samples.toml").samples
    assert set(samples) == {"predict", "correct.a b", "correct.a_b", "correct.für */"}


def test_differences_are_refused_in_single_precision() -> None:
    composed = ModularFilter(extended_predictor(_still, np.eye(1)), [Sensor("s", extended_corrector(_seen, np.eye(1)))])
    with pytest.raises(ValueError, match=r"predictor: it takes its Jacobian by differences, .* give it a jacobian"):
        files_of("still", Case(composed, np.zeros(1), np.eye(1), np.zeros(0)), "single")


def _still(x: np.ndarray, _u: np.ndarray, _dt: float, out: np.ndarray) -> None:
    out[0] = x[0]


def _seen(x: np.ndarray, out: np.ndarray) -> None:
    out[0] = x[0]
