"""Scheduling of real-time filter jobs on a simulated preemptive processor; knows nothing of estimation.

from sched_sim import Options, Timing, least_speed, load_costs, select

costs = select(load_costs("steffes2014"), "dual-rate", Options())
least_speed(costs, Timing(N=10, M=4, L=8))
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sched_sim.lazy import lazily

if TYPE_CHECKING:
    from sched_sim.costs.table import CostTable
    from sched_sim.costs.table_file import load_costs, read_costs, write_costs
    from sched_sim.design.fit import Fit, fit
    from sched_sim.design.least_speed import achieved_l, least_speed, staircase
    from sched_sim.design.less_work import less_work
    from sched_sim.design.methods import select
    from sched_sim.design.options import Options
    from sched_sim.design.simulate import simulate
    from sched_sim.design.times import Times
    from sched_sim.design.timing import Timing
    from sched_sim.errors import InputError
    from sched_sim.probability.cost_distribution import CostDistribution
    from sched_sim.probability.exact import probabilities
    from sched_sim.probability.outcome import Probabilities
    from sched_sim.processors.part import Part, on_part
    from sched_sim.processors.part_file import load_part
    from sched_sim.scenario.outcome import Outcome
    from sched_sim.scenario.rare import RareMisses, rare_misses
    from sched_sim.scenario.run import run_scenario
    from sched_sim.scenario.scenario import Scenario, Sensor
    from sched_sim.scenario.scenario_file import read_scenario
    from sched_sim.schedule.outcome import Schedule, Slice
    from sched_sim.schedule.task_file import read_tasks
    from sched_sim.schedule.tasks import Task
    from sched_sim.schedule.trace import open_trace

__all__ = [
    "CostDistribution",
    "CostTable",
    "Fit",
    "InputError",
    "Options",
    "Outcome",
    "Part",
    "Probabilities",
    "RareMisses",
    "Scenario",
    "Schedule",
    "Sensor",
    "Slice",
    "Task",
    "Times",
    "Timing",
    "achieved_l",
    "fit",
    "least_speed",
    "less_work",
    "load_costs",
    "load_part",
    "on_part",
    "open_trace",
    "probabilities",
    "rare_misses",
    "read_costs",
    "read_scenario",
    "read_tasks",
    "run_scenario",
    "select",
    "simulate",
    "staircase",
    "write_costs",
]

__getattr__, __dir__ = lazily(
    __name__,
    {
        "sched_sim.costs.table": "CostTable",
        "sched_sim.costs.table_file": "load_costs read_costs write_costs",
        "sched_sim.design.fit": "Fit fit",
        "sched_sim.design.least_speed": "achieved_l least_speed staircase",
        "sched_sim.design.less_work": "less_work",
        "sched_sim.design.methods": "select",
        "sched_sim.design.options": "Options",
        "sched_sim.design.simulate": "simulate",
        "sched_sim.design.times": "Times",
        "sched_sim.design.timing": "Timing",
        "sched_sim.errors": "InputError",
        "sched_sim.processors.part": "Part on_part",
        "sched_sim.processors.part_file": "load_part",
        "sched_sim.probability.cost_distribution": "CostDistribution",
        "sched_sim.probability.exact": "probabilities",
        "sched_sim.probability.outcome": "Probabilities",
        "sched_sim.scenario.outcome": "Outcome",
        "sched_sim.scenario.rare": "RareMisses rare_misses",
        "sched_sim.scenario.run": "run_scenario",
        "sched_sim.scenario.scenario": "Scenario Sensor",
        "sched_sim.scenario.scenario_file": "read_scenario",
        "sched_sim.schedule.outcome": "Schedule Slice",
        "sched_sim.schedule.task_file": "read_tasks",
        "sched_sim.schedule.tasks": "Task",
        "sched_sim.schedule.trace": "open_trace",
    },
)
