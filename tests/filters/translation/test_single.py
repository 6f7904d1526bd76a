"""Numbers that were chosen for doubles, in a program of floats."""

from __future__ import annotations

import importlib
import pkgutil
from typing import Any

import numpy as np
import pytest

import filters
from filters.kernels import quaternion, u_d
from filters.translation.kinds import Kind, kind_of
from filters.translation.library import Precision
from filters.translation.refusal import Untranslatable
from filters.translation.single import OWN, RESOLUTION
from filters.translation.unit import Unit


def translated(function: Any, *arguments: Any, precision: Precision = "single") -> str:
    kinds: tuple[Kind, ...] = tuple(kind_of(argument) for argument in arguments)
    unit = Unit(precision, frozenset({function}))
    unit.function(function, kinds)
    return unit.header("A_H") + unit.source("a.h")


def test_a_kernels_threshold_is_another_in_single_precision() -> None:
    def is_positive(x: Any, out: Any) -> None:
        out[0] = 1.0 if x > u_d.UNDERFLOWN else 0.0

    assert "1e-290" in translated(is_positive, 1.0, np.zeros(1), precision="double")
    assert "1e-29f" in translated(is_positive, 1.0, np.zeros(1))


def test_thresholds_of_single_precision_are_those_of_constants_that_there_are() -> None:
    found = set()
    for module in pkgutil.walk_packages(filters.__path__, "filters."):
        for name, value in vars(importlib.import_module(module.name)).items():
            if isinstance(value, float):
                found.add((name, value))
    assert set(OWN) <= found
    for value in OWN.values():
        assert np.float32(value) > 0.0


def test_what_a_float_cannot_hold_or_resolve_is_refused_with_its_line() -> None:
    def vanishing(x: Any, out: Any) -> None:
        out[0] = x + 1e-60

    def unresolved(x: Any, out: Any) -> None:
        out[0] = x if x > 1e-9 else 0.0

    for function, said in ((vanishing, "no 1e-60"), (unresolved, "1e-09 is less than single precision resolves")):
        with pytest.raises(Untranslatable, match=rf"test_single.py:\d+: .*{said}"):
            translated(function, 1.0, np.zeros(1))
        assert translated(function, 1.0, np.zeros(1), precision="double")


def test_a_small_number_that_is_no_threshold_is_kept() -> None:
    def noise(x: Any, out: Any) -> None:
        out[0] = x + 1e-9

    assert RESOLUTION > 1e-9
    assert "1e-09f" in translated(noise, 1.0, np.zeros(1))


def test_below_its_threshold_the_series_of_an_angle_is_as_exact_as_a_float() -> None:
    """Those of `quaternion.turn` and of `quaternion.rotation_between`."""
    squared = OWN["SMALL", quaternion.SMALL]
    angle = np.sqrt(squared)
    for series, exact in (
        (1.0 - 0.125 * squared, np.cos(0.5 * angle)),
        (0.5 - squared / 48.0, np.sin(0.5 * angle) / angle),
        (2.0 - squared / 1.5, 2.0 * np.arctan(angle) / angle),
    ):
        assert abs(series / exact - 1.0) < RESOLUTION
