"""Which of the two files of costs a TOML document is: a cost table of methods, or samples of one filter's parts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from sched_sim.costs.methods import METHODS
from sched_sim.errors import InputError, option

PREDICT = (
    "predict",
    "predict_accumulate",
    "carry_product",
    "hr_propagate",
    "hr_restart",
    "hr_update",
    "lr_propagate",
)
CORRECT = (
    "correct",
    "correct_accumulate",
    "correct_late",
    "carry",
    "beside",
    "land",
    "beside_product",
    "land_product",
    "gain",
    "gain_again",
    "gain_kept",
    "lr_correct",
    "hr_pass",
)
"""Parts of a filter. The first is there once; each of the second once for each sensor."""


def refuse_samples(document: Mapping[str, Any], what: str) -> None:
    """Raises InputError, with the use of such a file, for one of samples where a cost table is needed."""
    if "costs" not in document and ("samples" in document or _holds(document, "operations", (*PREDICT, *CORRECT))):
        raise InputError(
            f"{what} is a samples file, of the parts of one filter: name it as `costs` in a scenario, for `sched-sim "
            f"simulate --scenario FILE`, or give a cost table, with [costs.METHOD] or [operations.METHOD]"
        )


def refuse_cost_table(document: Mapping[str, Any], what: str) -> None:
    """Raises InputError, with the use of such a file, for a cost table where samples are needed."""
    if "samples" not in document and ("costs" in document or _holds(document, "operations", METHODS)):
        raise InputError(
            f"{what} is a cost table, of methods: give it to {option('costs')} of `minimum`, `simulate` or `sweep`, "
            f"and here a file that `sched-sim measure --filter` writes"
        )


def _holds(document: Mapping[str, Any], table: str, keys: Iterable[str]) -> bool:
    entries = document.get(table)
    return isinstance(entries, Mapping) and not set(keys).isdisjoint(entries)
