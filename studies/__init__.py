"""What is asked: cost measurement, sweeps, which filter is accurate enough, and the declared studies."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sched_sim.lazy import lazily

if TYPE_CHECKING:
    from studies.measurement.described import describe_filter
    from studies.measurement.methods import measure
    from studies.measurement.samples import measure_filter
    from studies.selection.choose import choose_filter
    from studies.selection.compare import compare_accuracy
    from studies.sweep.library import run_sweep

__all__ = ["choose_filter", "compare_accuracy", "describe_filter", "measure", "measure_filter", "run_sweep"]

__getattr__, __dir__ = lazily(
    __name__,
    {
        "studies.measurement.described": "describe_filter",
        "studies.measurement.methods": "measure",
        "studies.measurement.samples": "measure_filter",
        "studies.selection.choose": "choose_filter",
        "studies.selection.compare": "compare_accuracy",
        "studies.sweep.library": "run_sweep",
    },
)
