"""Models that a user might name on the command line."""

from __future__ import annotations

import numpy as np

from filters.accuracy import LinearModel
from filters.system import System
from filters.systems.linear import linear_system

Phi = np.array([[1.0, 1.0], [0.0, 1.0]])
Q = 0.01 * np.array([[1 / 3, 1 / 2], [1 / 2, 1.0]])
H, R = np.array([[1.0, 0.0]]), np.eye(1)


def cv() -> LinearModel:
    """Constant velocity."""
    return LinearModel(Phi, Q, H, R)


def cv_system() -> System:
    return linear_system(Phi, np.array([[0.5], [1.0]]), H, Q, R)


def cv_system_at() -> tuple[System, np.ndarray]:
    return cv_system(), np.array([3.0, 1.0])


def singular() -> LinearModel:
    return LinearModel(Phi, Q, H, np.zeros((1, 1)))


def nan() -> LinearModel:
    return LinearModel(Phi * np.nan, Q, H, R)


def infinite_system() -> System:
    return cv_system()._replace(Q=lambda _j, _p: Q * np.inf)


def hover() -> LinearModel:
    """Its yaw is never seen."""
    return LinearModel(np.eye(2), 0.01 * np.eye(2), H, R, ("position", "yaw"))


def hover_system() -> System:
    return linear_system(np.eye(2), np.zeros((2, 1)), H, 0.01 * np.eye(2), R)


def wrong_shape() -> LinearModel:
    return LinearModel(Phi, Q, np.ones((1, 3)), R)


def nothing() -> int:
    return 3


def fails() -> System:
    raise RuntimeError("the battery is flat")


def turning() -> LinearModel:
    """By a twentieth of a turn in a step."""
    c, s = np.cos(np.pi / 10), np.sin(np.pi / 10)
    return LinearModel(np.array([[c, -s], [s, c]]), 1e-4 * np.eye(2), np.array([[1.0, 0.0]]), np.array([[0.04]]))
