"""Whose code it is: the user's, this project's, or an installed library's."""

from __future__ import annotations

import json
from types import FunctionType
from typing import cast

import pytest
import scipy.linalg
from scipy.linalg import expm

from filters.backends.installed import is_foreign, is_installed
from filters.kernels.dense import matmul


def own() -> None: ...


@pytest.mark.parametrize(("function", "installed"), [(own, False), (matmul, False), (json.dumps, True), (expm, True)])
def test_code_is_known_by_its_file(function: FunctionType, installed: bool) -> None:
    assert is_installed(function.__code__.co_filename) is installed


def test_what_a_library_calls_of_its_own_is_not_foreign_to_it() -> None:
    assert is_foreign(expm, cast(FunctionType, own))
    assert not is_foreign(expm, cast(FunctionType, scipy.linalg.logm))
    assert not is_foreign(cast(FunctionType, own), cast(FunctionType, expm))
