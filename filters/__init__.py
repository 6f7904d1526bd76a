"""Estimation with delayed measurements; knows nothing of scheduling."""

from __future__ import annotations

from typing import TYPE_CHECKING

from filters.lazy import lazily

if TYPE_CHECKING:
    from filters import accuracy, modular, multirate_gain
    from filters.backends.counted import Operations, count
    from filters.delayed import (
        augmentation,
        carried_gain,
        clone,
        clone_split,
        delayed_horizon,
        dual_rate,
        fuse_as_fresh,
        larsen,
        px4_predictor,
        recalculate,
        standard,
    )
    from filters.error_covariance import true_covariance
    from filters.history import History
    from filters.sparse.structure import Structure
    from filters.system import System
    from filters.systems.example import example_system
    from filters.systems.linear import linear_system

__all__ = [
    "History",
    "Operations",
    "Structure",
    "System",
    "accuracy",
    "augmentation",
    "carried_gain",
    "clone",
    "clone_split",
    "count",
    "delayed_horizon",
    "dual_rate",
    "example_system",
    "fuse_as_fresh",
    "larsen",
    "linear_system",
    "modular",
    "multirate_gain",
    "px4_predictor",
    "recalculate",
    "standard",
    "true_covariance",
]

__getattr__, __dir__ = lazily(
    __name__,
    {
        "filters": "accuracy modular multirate_gain",
        "filters.backends.counted": "Operations count",
        "filters.delayed": "augmentation carried_gain clone clone_split delayed_horizon dual_rate fuse_as_fresh larsen "
        "px4_predictor recalculate standard",
        "filters.error_covariance": "true_covariance",
        "filters.history": "History",
        "filters.sparse.structure": "Structure",
        "filters.system": "System",
        "filters.systems.example": "example_system",
        "filters.systems.linear": "linear_system",
    },
)
