"""What is written is read back."""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
import pytest

from sched_sim.files.toml_writer import toml_value


@pytest.mark.parametrize(
    "value",
    ['a "quoted" text', 2, 0.1, True, [1, 2], {"a key": 1, "b": [0.5]}, np.int64(2), np.float32(0.5), [np.bool_(True)]],
    ids=repr,
)
def test_a_value_is_read_back(value: Any) -> None:
    assert tomllib.loads(f"value = {toml_value(value)}") == {"value": value}
