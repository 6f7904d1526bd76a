"""Random programs: where C is made of one, it does what Python does, to the last bit."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.exhaust import share_of
from tests.filters.translation.cases import check_same, needs_compiler
from tests.filters.translation.programs import HEADER, Program


def module_of(path: Path, seeds: range) -> Any:
    """The programs of these seeds, in a file, from which a function's source is read."""
    path.write_text(HEADER + "\n\n".join(Program(seed).text(f"program_{seed}") for seed in seeds))
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module
    spec.loader.exec_module(module)
    return module


def check(folder: Path, seeds: range) -> None:
    module = module_of(folder / f"programs_{seeds.start}.py", seeds)
    for seed in seeds:
        random = np.random.default_rng(seed)
        x, P = random.normal(size=4) * 3.0, random.normal(size=(3, 3))
        for i, j in ((0, 1), (3, 8)):
            a, b = random.normal(size=2) * 2.0
            check_same(getattr(module, f"program_{seed}"), float(a), float(b), i, j, x, P)


@needs_compiler
def test_thirty_programs(tmp_path: Path) -> None:
    check(tmp_path, range(30))


@needs_compiler
@pytest.mark.exhaust
@pytest.mark.parametrize("number", range(10))
def test_five_thousand_programs(tmp_path: Path, number: int) -> None:
    check(tmp_path, range(1000 + 500 * number, 1000 + 500 * number + share_of(500)))
