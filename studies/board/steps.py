"""The steps of a filter around its jobs, and the files that are made of them."""

from __future__ import annotations

from typing import NamedTuple


class Steps(NamedTuple):
    """N: HR steps from one measurement to the next. M: until it arrives. L: until the correction lands."""

    N: int
    M: int
    L: int


class Files(NamedTuple):
    """files: texts by name. sizes: of the arrays in RAM, how many numbers each has; of tasks,
    those of HR begin with hr_, those of LR with lr_."""

    files: dict[str, str]
    sizes: dict[str, int]
