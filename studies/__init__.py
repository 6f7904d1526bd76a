"""What is asked: cost measurement, sweeps, which filter is accurate enough, all of one design or scenario,
and the declared studies."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sched_sim.lazy import lazily

if TYPE_CHECKING:
    from studies.explorer.design import Design
    from studies.explorer.scenario import ScenarioView, explore_scenario
    from studies.explorer.scenario_asked import ScenarioAsked
    from studies.explorer.view import View, explore
    from studies.measurement.described import describe_filter
    from studies.measurement.methods import measure
    from studies.measurement.samples import measure_filter
    from studies.selection.choose import choose_filter
    from studies.selection.compare import compare_accuracy
    from studies.sweep.library import run_sweep

__all__ = [
    "Design",
    "ScenarioAsked",
    "ScenarioView",
    "View",
    "choose_filter",
    "compare_accuracy",
    "describe_filter",
    "explore",
    "explore_scenario",
    "measure",
    "measure_filter",
    "run_sweep",
]

__getattr__, __dir__ = lazily(
    __name__,
    {
        "studies.explorer.design": "Design",
        "studies.explorer.scenario": "ScenarioView explore_scenario",
        "studies.explorer.scenario_asked": "ScenarioAsked",
        "studies.explorer.view": "View explore",
        "studies.measurement.described": "describe_filter",
        "studies.measurement.methods": "measure",
        "studies.measurement.samples": "measure_filter",
        "studies.selection.choose": "choose_filter",
        "studies.selection.compare": "compare_accuracy",
        "studies.sweep.library": "run_sweep",
    },
)
