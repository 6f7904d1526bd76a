"""Run all benchmarks and print each figure beside its target; exit code 1 if one is missed."""

from __future__ import annotations

import sys

from benchmarks import (
    accuracy,
    analysis,
    cluster,
    explorer,
    explorer_page,
    factored,
    filter_step,
    gantt,
    in_c,
    plots,
    probability,
    processor,
    robust,
    scenario,
    scenario_trace,
    simulation,
    sparse,
    start_up,
    unscented,
)

missed = 0
for part in (
    simulation,
    analysis,
    accuracy,
    filter_step,
    in_c,
    sparse,
    unscented,
    factored,
    robust,
    scenario,
    scenario_trace,
    probability,
    processor,
    cluster,
    gantt,
    plots,
    explorer,
    explorer_page,
    start_up,
):
    for result in part.results():
        missed += not result.met
        bound = "at least" if result.higher else "at most"
        verdict = "met" if result.met else "MISSED"
        print(
            f"{result.name:60} {result.value:9.2f} {result.unit:20} {bound:8} {result.target:g}  {verdict}", flush=True
        )
sys.exit(1 if missed else 0)
