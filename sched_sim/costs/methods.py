"""The names of the methods, and of the jobs whose costs a table holds."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, get_args

PaperMethod = Literal["standard", "recalculate", "larsen", "dual-rate"]
DelayedMethod = Literal[
    PaperMethod,
    "clone",
    "clone-split",
    "carried-gain",
    "delayed-horizon",
    "px4-predictor",
    "augmentation",
    "fuse-as-fresh",
]
MultirateMethod = Literal["multirate", "multirate-square-root", "multirate-ud"]
RobustMethod = Literal["robust-inverse", "robust-givens", "robust-lu", "robust-closed"]
Method = Literal[DelayedMethod, MultirateMethod, RobustMethod]
PAPER_METHODS: tuple[PaperMethod, ...] = get_args(PaperMethod)
"""Those of Steffes 2014."""
DELAYED_METHODS: tuple[DelayedMethod, ...] = get_args(DelayedMethod)
"""One measurement every N steps, that comes M steps late; and the standard filter, for which it is never late."""
MULTIRATE_METHODS: tuple[MultirateMethod, ...] = get_args(MultirateMethod)
"""A measurement in every step, covariance and gain every N-th ("Optimal covariance filtering", a patent, Eq. 1)."""
ROBUST_METHODS: tuple[RobustMethod, ...] = get_args(RobustMethod)
"""Inertial propagation in every step, and once in N steps the extended robust filter, whose linear system is solved in
one of four ways (Yengera, Inoue, Narasimha, Terra, arXiv:1801.04386)."""
SYSTEM_METHODS: tuple[Method, ...] = (*DELAYED_METHODS, *MULTIRATE_METHODS)
"""Those that run on any system model."""
TWO_RATE_METHODS: tuple[Method, ...] = (*MULTIRATE_METHODS, *ROBUST_METHODS)
"""An HR job in every step, an LR job once in N steps, whose result is in use by step l; no delayed measurement."""
METHODS: tuple[Method, ...] = (*DELAYED_METHODS, *TWO_RATE_METHODS)

KINDS: Mapping[str, tuple[str, ...]] = {
    "standard": ("propagate", "update"),
    "recalculate": ("propagate", "update", "replay"),
    "larsen": ("propagate", "propagate_accumulate", "update", "gain", "correct", "compensate"),
    "dual-rate": (
        "hr_propagate",
        "hr_propagate_sum",
        "hr_propagate_euler",
        "hr_restart",
        "hr_update",
        "lr_propagate",
        "lr_propagate_euler",
        "lr_update",
        "lr_gain",
        "lr_correct",
    ),
    "clone": ("propagate", "start", "carry", "update", "couple", "compensate"),
    "clone-split": ("propagate", "start", "carry", "update"),
    "carried-gain": ("propagate", "update", "carry", "land", "couple", "compensate"),
    "delayed-horizon": ("predict", "update", "replay", "propagate_covariance"),
    "px4-predictor": ("predict", "propagate", "update", "pull", "shift_output"),
    "augmentation": ("predict_0", "predict_1", "update_0", "update_1", "update_2"),
    "fuse-as-fresh": ("propagate", "update"),
    **dict.fromkeys(MULTIRATE_METHODS, ("state_update", "covariance_gain")),
    **dict.fromkeys(ROBUST_METHODS, ("inertial", "robust_step")),
}
"""Every entry a table may hold, by method. Those a run needs depend on its options: see `select`."""

CAVEATS: Mapping[str, str] = {
    "px4-predictor": "approximate output: it follows a correction with a time constant of its own, and does not jump",
    "fuse-as-fresh": "wrong by design: a late measurement is taken for a new one, and the estimate lags by what moved "
    "during the delay",
}
"""Methods whose estimate is not the one that the measurements allow: a word or two, and why."""
