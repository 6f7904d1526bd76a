"""Why factors are kept: they stay accurate where a covariance of as many digits becomes indefinite."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from filters.factored import FactoredFormName, factored_form
from filters.factored.workspace import new_factored_workspace
from filters.systems.linear import linear_system

each_factorisation = pytest.mark.parametrize("name", ["square-root", "u-d"])

PRIOR, NOISE, TILT = 1e12, 1e-6, 1e-4
H = np.array([[1.0, 1.0, 1.0], [1.0, 1.0, 1.0 + TILT]])
"""Two measurements of nearly the same sum of three states that were all but unknown: Bierman's kind of example."""


def covariance_after(name: FactoredFormName) -> Any:
    system = linear_system(np.eye(3), np.zeros((3, 1)), H, np.zeros((3, 3)), NOISE * np.eye(2))
    form, work = factored_form(name, "short"), new_factored_workspace(system)
    factors, after, K, P = np.zeros((3, 3)), np.zeros((3, 3)), np.zeros((3, 2)), np.zeros((3, 3))
    form.factor(PRIOR * np.eye(3), factors)
    form.update(factors, H, NOISE * np.eye(2), K, after, work)
    form.covariance(after, P)
    return P


def exact_covariance_after() -> Any:
    """[P^-1 + H^T R^-1 H]^-1 of the very same floating-point numbers, in fractions."""
    information = [
        [
            (Fraction(1) / Fraction(PRIOR) if i == j else Fraction(0))
            + sum(Fraction(float(h[i])) * Fraction(float(h[j])) / Fraction(NOISE) for h in H)
            for j in range(3)
        ]
        for i in range(3)
    ]
    return np.array(inverse(information), dtype=np.float64)


def inverse(A: list[list[Fraction]]) -> list[list[Fraction]]:
    n = len(A)
    rows = [[*row, *(Fraction(int(i == j)) for j in range(n))] for i, row in enumerate(A)]
    for i in range(n):
        rows[i] = [value / rows[i][i] for value in rows[i]]
        for j in range(n):
            if j != i:
                rows[j] = [a - rows[j][i] * b for a, b in zip(rows[j], rows[i], strict=True)]
    return [row[n:] for row in rows]


def worst_deviation(P: Any) -> float:
    """The greatest error of an element, beside the standard deviations of its two states."""
    expected = exact_covariance_after()
    deviations = np.sqrt(np.diag(expected))
    return float(np.max(np.abs(P - expected) / np.outer(deviations, deviations)))


def test_the_conventional_covariance_is_lost() -> None:
    """The third state gets a variance of -16000 where it should be 200."""
    P = covariance_after("conventional")
    assert P[2, 2] < 0
    assert worst_deviation(P) > 10


@each_factorisation
def test_the_factors_keep_it(name: FactoredFormName) -> None:
    """To what rounding leaves of a number when deviations, not variances, lie so far apart."""
    rounding = np.finfo(float).eps * np.sqrt(PRIOR / NOISE)
    assert worst_deviation(covariance_after(name)) < rounding
