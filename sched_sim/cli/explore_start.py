"""What `sched-sim explore` starts with: the design that its page begins with, and what of the user's own it offers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from studies.explorer.given import Given
    from studies.explorer.scenario_runs import Runs


def begun(path: Path, model: str | None, output: str | None) -> Runs:
    """The runs of a scenario, of which the first is made. model, output: of the accuracy, where its file does not say
    them. Raises InputError for what cannot be simulated."""
    from sched_sim.cli.scenario import describe
    from sched_sim.cli.scenario_accuracy import question
    from sched_sim.cli.scenario_flags import NOTHING_ASKED
    from sched_sim.scenario.scenario_file import read_scenario
    from studies.explorer.scenario_runs import Runs

    scenario = read_scenario(path, describe)
    runs = Runs(scenario, question(scenario, path, NOTHING_ASKED._replace(model=model, output=output)))
    runs.view("")
    return runs


TIMES = ("N", "M", "hr_hz", "measurement_hz", "delay_ms")


def started(said: Mapping[str, Any], costs: str | None, processor: str | None, tasks: Path | None) -> Given:
    """said: arguments of `Design`, those that the user gave; costs, processor: shipped ones by name, or paths.

    Where nothing is said of times, they are those of the shipped model that is named, else of the design that an
    explorer starts with. Raises InputError for files and functions that cannot be read.
    """
    from filters.accuracy.shipped import SHIPPED_MODELS
    from sched_sim.costs.table_file import load_costs, shipped_tables
    from sched_sim.processors.part_file import load_part, shipped_parts
    from studies.explorer.design import Design
    from studies.explorer.given import START, Given
    from studies.selection.model import load_model

    model = said.get("model")
    own_costs, own_parts, own_models = {}, {}, {}
    if costs is not None and costs not in shipped_tables():
        table = load_costs(costs)
        costs, own_costs = table.name, {table.name: table}
    if processor is not None and processor not in shipped_parts():
        part = load_part(processor)
        processor, own_parts = part.name, {part.name: part}
    if model is not None and model not in SHIPPED_MODELS:
        own_models = {model: load_model(model, None)}
    begun = Design() if model in SHIPPED_MODELS or any(name in said for name in TIMES) else START
    design = replace(begun, **said, costs=costs, processor=processor)
    return Given(own_costs, own_parts, own_models, tasks or (), design)
