"""Costs of sparse filters: by any backend but NumPy's, of methods that leave zeros out; the cost table says so."""

from __future__ import annotations

import numpy as np
import pytest

from filters.systems.navigation import STRUCTURE, vehicle
from sched_sim.errors import InputError
from studies.measurement.methods import measure
from studies.measurement.sparsity import with_structure
from tests.boards import needs_board

STATED = vehicle()._replace(structure=STRUCTURE)
X0 = np.array([0.0, 0.0, 0.5, 15.0, 0.0, 0.0])


def test_the_table_says_what_was_measured() -> None:
    sparse = measure(STATED, "counted", name="sparse", x0=X0, sparse=True, methods=["standard"])
    dense = measure(STATED, "counted", name="dense", x0=X0, methods=["standard"])
    assert (sparse.structure, dense.structure) == ("sparse", "dense")
    assert sparse.entry("standard", "propagate").minimum == 128
    assert dense.entry("standard", "propagate").minimum == 850


@needs_board
def test_a_core_does_less_too() -> None:
    sparse, dense = (
        measure(
            STATED, "emulated", "short", name="m4f", x0=X0, sparse=is_sparse, methods=["standard"], target="cortex-m4f"
        )
        for is_sparse in (True, False)
    )
    for kind in ("propagate", "update"):
        assert sparse.entry("standard", kind).minimum < 0.7 * dense.entry("standard", kind).minimum


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"system": vehicle()}, "the system states no structure"),
        ({"backend": "numpy"}, "backend='numpy' multiplies whole matrices"),
        ({"methods": ["larsen", "augmentation"]}, "augmentation multiplies zeros too; give some of standard"),
    ],
)
def test_what_cannot_be_sparse_is_refused(options: dict[str, object], said: str) -> None:
    arguments: dict[str, object] = {"system": STATED, "backend": "counted", "name": "no", "x0": X0, "sparse": True}
    with pytest.raises(InputError, match=said):
        measure(**{**arguments, **options})  # type: ignore[arg-type]


def test_what_is_stated_is_held_against_the_model() -> None:
    assert with_structure(STATED, X0, "--system", confirmed=False).structure == STRUCTURE
    assert with_structure(vehicle(), X0, "--system", confirmed=True).structure == STRUCTURE
    wrong = vehicle()._replace(structure=STRUCTURE._replace(H=("100000", "000000")))
    with pytest.raises(InputError, match=r"H\[1, 1\] is not always 0"):
        with_structure(wrong, X0, "--system", confirmed=True)
