"""C without the zeros of a model gives the bits of the dense filter, and finds a zero that is none."""

from __future__ import annotations

from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

from filters.covariance_forms import CovarianceFormName
from filters.sparse.structure import Structure
from filters.system import System
from filters.systems.linear import linear_system
from studies.board.steps import Steps
from tests.studies.board.build import build, needs_gcc, put, ran, written
from tests.studies.board.systems import pendulum

PENDULUM = pendulum()._replace(structure=Structure(F=("1*", "*1"), H=("*0",), Q=("*0", "0*"), R=("*",)))
WRONG = PENDULUM._replace(structure=Structure(F=("1*", "01"), H=("*0",), Q=("*0", "0*"), R=("*",)))


@needs_gcc
@pytest.mark.parametrize("method", ["dual-rate", "standard", "recalculate", "larsen", "delayed-horizon"])
@pytest.mark.parametrize("update", ["textbook", "short"])
def test_the_bits_are_those_of_the_dense_filter(tmp_path: Path, method: str, update: CovarianceFormName) -> None:
    steps = None if method == "delayed-horizon" else Steps(8, 0 if method == "standard" else 3, 5)
    files = written(PENDULUM, method=method, update=update, steps=steps)
    put(tmp_path, files)
    sources = [name for name in ("filter.c", "tasks.c", "steps.c", "test.c") if name in files]
    build(tmp_path, "-DTOLERANCE=0", *sources, "-o", "test", "-lm")
    status, printed = ran(tmp_path, "test")
    assert status == 0, printed
    assert "off by" not in printed


@needs_gcc
def test_a_matrix_that_is_known_in_full_leaves_no_warning(tmp_path: Path) -> None:
    noise = np.diag([0.1, 0.2])
    system: System = linear_system([[1.0, 0.5], [0.0, 1.0]], [[0.0], [1.0]], [[1.0, 0.0]], noise, [[0.3]])
    stated = system._replace(structure=Structure(F=("1*", "01"), H=("10",), Q=("*0", "0*"), R=("*",)))
    put(tmp_path, written(stated, update="short", steps=Steps(8, 3, 5)))
    build(tmp_path, "filter.c", "tasks.c", "test.c", "-o", "test", "-lm")
    assert ran(tmp_path, "test")[0] == 0


def test_a_zero_that_is_none_is_found_before_anything_is_written() -> None:
    with pytest.raises(ValueError, match=r"step 0: F\(j, x, u, p\) has .* at \[1, 0\], where the structure .* says 0"):
        written(WRONG, steps=Steps(8, 3, 5))


@needs_gcc
def test_and_by_the_test_of_the_folder(tmp_path: Path) -> None:
    """If nothing had looked before."""
    with patch("filters.problem.checked", lambda system, _: system):
        put(tmp_path, written(WRONG, steps=Steps(8, 3, 5)))
    build(tmp_path, "filter.c", "tasks.c", "test.c", "-o", "test", "-lm")
    status, printed = ran(tmp_path, "test")
    assert status == 1
    assert "FAILED" in printed


def test_no_comment_speaks_of_loops_that_are_not_there() -> None:
    assert "innermost loop" not in written(PENDULUM, update="short", steps=Steps(8, 3, 5))["filter.c"]
