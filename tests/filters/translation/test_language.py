"""What of the language is translated: the same numbers come out of C, to the last bit."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from filters.backends.in_c import in_c
from filters.translation.kinds import kind_of
from filters.translation.library import Precision
from filters.translation.names import c_name
from filters.translation.unit import Unit
from tests.filters.translation.cases import check_same, needs_compiler
from tests.filters.translation.functions import (
    CASES,
    guarded,
    guarded_at_length,
    guarded_by_name,
    guarded_inside,
    without_fraction,
)


@needs_compiler
@pytest.mark.parametrize(("function", "sets"), CASES, ids=lambda value: getattr(value, "__name__", ""))
def test_python_and_c_agree(function: Any, sets: list[tuple[Any, ...]]) -> None:
    for arguments in sets:
        check_same(function, *arguments)


@needs_compiler
@pytest.mark.parametrize("function", [guarded, guarded_by_name, guarded_at_length])
def test_what_a_function_raises_is_raised(function: Any) -> None:
    with pytest.raises(ValueError, match="too cold") as expected:
        function(-300.0)
    with pytest.raises(ValueError, match="too cold") as found:
        in_c(function)(-300.0)
    assert str(found.value) == str(expected.value)
    assert in_c(function)(0.0) == 10.0


@needs_compiler
@pytest.mark.parametrize("x", [np.nan, np.inf, 2147483648.0, -2.2e9])
def test_int_of_what_no_int_holds_is_an_error(x: float) -> None:
    with pytest.raises(ValueError, match=r"int\(\) of a number that an int of 32 bits does not hold"):
        in_c(without_fraction)(x)


@needs_compiler
def test_what_is_raised_further_in_ends_it_all() -> None:
    """What it would return is not there to be read; and the loop that times it ends too."""
    cold = np.array([3.0, 1.0, 0.0, 0.0])
    with pytest.raises(ValueError, match="too cold"):
        in_c(guarded_inside)(cold, 4.0)
    with pytest.raises(ValueError, match="too cold"):
        in_c(guarded_inside).loop(cold, 4.0)(10)
    assert in_c(guarded_inside)(cold, 2.0) == 8.0


@needs_compiler
@pytest.mark.parametrize("precision", ["single", "double"])
def test_the_strictest_warnings_find_nothing(precision: Precision, tmp_path: Path) -> None:
    unit = Unit(precision, public=frozenset(function for function, _ in CASES))
    for function, sets in CASES:
        for arguments in sets:
            unit.function(function, tuple(kind_of(argument) for argument in arguments))
    (tmp_path / "filter.h").write_text(unit.header("FILTER_H"))
    (tmp_path / "filter.c").write_text(unit.source("filter.h"))
    compiler = shutil.which("gcc") or shutil.which("cc") or "clang"
    warnings = ("all", "extra", "pedantic", "conversion", "double-promotion", "shadow", "error")
    flags = ["-std=c99", *(f"-W{name}" for name in warnings), "-O2", "-c"]
    done = subprocess.run([compiler, *flags, "filter.c"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_same_c_comes_out_of_every_process() -> None:
    """Whatever order the sets of that process have."""
    program = (
        "import numpy as np\n"
        "from filters.covariance_forms.short import gain; from filters.records import new_workspace\n"
        "from filters.systems.example import example_system; from filters.translation.kinds import kind_of\n"
        "from filters.translation.unit import Unit\n"
        "unit, arrays = Unit(public=frozenset({gain})), [np.zeros(n) for n in ((4, 4), (3, 4), (3, 3), (4, 3))]\n"
        "unit.function(gain, tuple(map(kind_of, (*arrays, new_workspace(example_system(4, 2, 3))))))\n"
        "print(unit.source(''))"
    )
    texts = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "PYTHONHASHSEED": seed},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for seed in ("0", "1", "2")
    }
    assert len(texts) == 1


def test_names_are_of_the_letters_that_c_has() -> None:
    assert [c_name(name) for name in ("_f", "my-model_f", "2d_f", "\u03a6", "int", "x")] == [
        "f",
        "my_model_f",
        "n2d_f",
        "u3a6",
        "int_",
        "x",
    ]
