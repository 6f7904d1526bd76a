"""The extended robust filter leaves the bits of `filters.robust.extended.run`, in each way of computing its step."""

from __future__ import annotations

from pathlib import Path

import pytest

from filters.robust.step import WAYS, WayName
from filters.translation.library import Precision
from studies.board.robust import Robust, robust_files
from studies.robust.costs import SYSTEMS, SystemName, robust_case
from tests.studies.board.build import build, needs_gcc, put, ran, ran_as_one, without_sizes

FEW = ("attitude", "closed")


def files_of(name: SystemName, way: WayName, precision: Precision) -> dict[str, str]:
    with without_sizes():
        return robust_files(Robust(name, robust_case(name), way, precision, 4, "sched-sim code"))


@needs_gcc
@pytest.mark.parametrize(
    ("name", "way"),
    [
        pytest.param(name, way, marks=() if (name, way) == FEW else pytest.mark.exhaust)
        for name in SYSTEMS
        for way in WAYS
    ],
)
def test_whole_runs_give_the_bits_of_python(name: SystemName, way: WayName, tmp_path: Path) -> None:
    """Sines of the C library may differ from NumPy's in the last bit."""
    put(tmp_path, files_of(name, way, "double"))
    status, said = ran_as_one(tmp_path, "filter.c", "steps.c", "test.c")
    assert status == 0, said


@needs_gcc
@pytest.mark.exhaust
@pytest.mark.parametrize("way", WAYS)
def test_in_single_precision(way: WayName, tmp_path: Path) -> None:
    put(tmp_path, files_of("attitude", way, "single"))
    build(tmp_path, "-O2", "filter.c", "steps.c", "test.c", "-lm", "-o", "test")
    status, said = ran(tmp_path, "test")
    assert status == 0, said


def test_memory_that_a_way_does_not_use_is_not_there() -> None:
    state = files_of("attitude", "closed", "single")["state.h"]
    assert "filter_seen_work_rows" in state
    assert "static const real filter_seen_model_H" in state
    assert "static real filter_seen_model_F" in state
