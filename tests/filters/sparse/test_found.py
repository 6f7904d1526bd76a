"""The structure of a linear system is known; of others it is probed, and what is stated is held against that."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from filters.sparse.found import contradiction, linear_structure, probed
from filters.sparse.structure import Structure
from filters.system import System
from filters.systems.example import example_system
from filters.systems.gps import STRUCTURE as GPS
from filters.systems.gps import gps
from filters.systems.linear import linear_system
from filters.systems.navigation import STRUCTURE as VEHICLE
from filters.systems.navigation import vehicle


def test_what_shipped_models_state_is_what_probing_finds() -> None:
    assert probed(vehicle(), np.array([0.0, 0.0, 0.5, 15.0, 0.0, 0.0])) == VEHICLE
    assert probed(gps(period_s=0.5), np.zeros(8)) == GPS


def test_of_a_linear_system_the_matrices_of_all_steps_are_looked_at() -> None:
    Phi = np.array([[[1.0, 0.0], [0.0, 1.0]], [[1.0, 0.5], [0.0, 1.0]]])
    system = linear_system(Phi, np.zeros((2, 0)), [[1.0, 0.0]], np.diag([0.0, 1.0]), [[2.0]])
    expected = Structure(F=("1*", "01"), H=("10",), Q=("00", "0*"), R=("*",))
    assert linear_structure(system) == expected
    assert probed(system, np.zeros(2)) == expected
    assert linear_structure(vehicle()) is None


def test_the_example_has_no_zeros() -> None:
    structure = linear_structure(example_system(4, 1, 2))
    assert structure is not None
    assert set("".join(structure.F + structure.H + structure.Q + structure.R)) == {"*"}


def test_a_contradiction_is_named() -> None:
    assert contradiction(VEHICLE, VEHICLE) is None
    assert contradiction(VEHICLE._replace(H=("*00000", "010000")), VEHICLE) is None
    assert contradiction(VEHICLE, VEHICLE._replace(F=("1****0", *VEHICLE.F[1:]))) == "F[0, 1] is not always 0"
    assert contradiction(VEHICLE._replace(R=("10", "0*")), VEHICLE) == "R[0, 0] is not always 1"


def _rarely(_j: int, x: Any, _u: Any, _p: Any) -> Any:
    return np.array([[1.0, 0.1 if x[0] > 1e6 else 0.0], [0.0, 1.0]])


def test_probing_is_no_proof() -> None:
    system = linear_system(np.eye(2), np.zeros((2, 0)), [[1.0, 0.0]], np.eye(2), [[2.0]])._replace(F=_rarely)
    assert probed(system, np.zeros(2)).F == ("10", "01")
    assert probed(system, np.array([1e7, 0.0])).F == ("1*", "01")


def _failing(_j: int, x: Any, _u: Any, _p: Any) -> Any:
    if abs(x[0]) > 0.001:
        raise ValueError("pole")
    return np.eye(2)


def test_a_model_that_fails_nearly_everywhere_cannot_be_probed() -> None:
    system: System = linear_system(np.eye(2), np.zeros((2, 0)), [[1.0, 0.0]], np.eye(2), [[2.0]])._replace(F=_failing)
    with pytest.raises(ValueError, match="cannot be found by probing; state its structure"):
        probed(system, np.zeros(2))
