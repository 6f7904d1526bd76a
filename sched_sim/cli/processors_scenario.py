"""`sched-sim processors --scenario`: on which parts a scenario misses nothing, by simulation."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sched_sim.cli.no_time import no_time_note
from sched_sim.cli.output import Format, lines, print_csv, print_json, print_table
from sched_sim.cli.parts import WORDS
from sched_sim.cli.progress import progress_bar
from sched_sim.cli.scenario import describe
from sched_sim.cli.scenario_accuracy import accuracy_of, over_the_same_steps, question, verdict_columns, verdict_words
from sched_sim.cli.scenario_flags import NOTHING_ASKED
from sched_sim.errors import InputError
from sched_sim.shares import percent

if TYPE_CHECKING:
    from sched_sim.scenario.outcome import Outcome
    from sched_sim.scenario.scenario import Scenario, Sensor
    from studies.selection.in_scenario import ScenarioAccuracy


def verdicts(path: Path, processors: Sequence[str], format: Format) -> None:
    """Prints a row for each: what misses nothing first, with the least slack of them at the top. Raises InputError if
    the scenario cannot be read for any of them."""
    from sched_sim.processors.part import NoTimeError
    from sched_sim.processors.part_file import load_part
    from sched_sim.scenario.run import run_scenario
    from sched_sim.scenario.said import phases_note
    from sched_sim.scenario.scenario_file import read_scenario

    parts = {path: load_part(path).name for path in processors}
    rows: list[dict[str, Any]] = []
    lacking: dict[str, Sequence[str]] = {}
    scenario: Scenario | None = None
    read: list[Scenario] = []
    accuracies: dict[str, ScenarioAccuracy] = {}
    for file, name in parts.items():
        try:
            scenario = read_scenario(path, describe, processor=file)
        except NoTimeError as error:
            if len(processors) == 1:
                raise
            rows.append(dict.fromkeys(KEYS) | {"processor": name, "reason": str(error)})
            lacking[name] = error.operations
            continue
        read.append(scenario)
        about = question(scenario, path, NOTHING_ASKED)
        with progress_bar(f"On {name}") as progress:
            outcome = run_scenario(scenario, on_progress=progress)
        rows.append(_row(name, scenario, outcome))
        if about is not None:
            accuracies[name] = accuracy_of(about, scenario, outcome)
    if scenario is None:
        raise InputError(f"--scenario {str(path)!r}: {no_time_note(lacking)}")
    rows.sort(key=_by_slack)
    accuracies = dict(zip(accuracies, over_the_same_steps([*accuracies.values()]), strict=True))
    for row in rows if accuracies else ():
        accuracy = accuracies.get(row["processor"])
        row |= dict.fromkeys(DEVIATIONS) if accuracy is None else verdict_columns(accuracy)
    if format == "json":
        print_json(rows)
    elif format == "csv":
        print_csv([_flat(row, scenario) for row in rows])
    else:
        title = f"{scenario.name}: {scenario.steps} steps at {float(scenario.hr_hz or 0):g} Hz, seed {scenario.seed}"
        note = (
            f"fits: nothing was missed in these {scenario.steps} steps; slack: what the tightest job had left of the "
            f"time from its release to its deadline; lands: the latest of each sensor, from when the measurement is "
            f"taken"
        )
        shown = [_in_words(row, scenario) for row in rows]
        if accuracies:
            heading = next(iter(accuracies.values()))
            shown = [
                words | verdict_words(accuracies.get(row["processor"]), heading)
                for words, row in zip(shown, rows, strict=True)
            ]
            at_start = ", of the model linearised at its start" if heading.question.model.linearised else ""
            note = lines(
                note, f"std: of {heading.question.outputs.name}{at_start}, steps {heading.first} to {heading.last}"
            )
        print_table(title, shown, lines(note, _same(read), phases_note(scenario), no_time_note(lacking)))


DEVIATIONS = ("output", "output_unit", "median_std", "p95_std", "worst_std")
KEYS = ("processor", "fits", "jobs", "misses", "miss_share", "slack", "slack_of", "utilization", "latest_l",
        "correction_ms", "reason")  # fmt: skip
OF_SENSORS = ("latest_l", "correction_ms")
"""The keys of these that hold a figure for each sensor."""


def _same(scenarios: Sequence[Scenario]) -> str:
    """A line with what takes as long on every processor, for the file states it in seconds; empty where nothing does.

    scenarios: the one of the file, on each.
    """
    first, *others = scenarios
    parts = [part for part, costs in first.costs.items() if all(other.costs[part] == costs for other in others)]
    named = [*(part.replace(".", " ") for part in parts), *(task.name for task in first.tasks)]
    return f"as long on every processor, as the file states: {', '.join(named)}" if others and named else ""


def _by_slack(row: dict[str, Any]) -> tuple[int, float]:
    """What fits, the least slack first; what does not, the fewest misses first; what is not known."""
    if row["fits"] is None:
        return 2, 0.0
    return (0, row["slack"] or 0.0) if row["fits"] else (1, row["miss_share"])


def _row(name: str, scenario: Scenario, outcome: Outcome) -> dict[str, Any]:
    """slack: the least margin of all jobs, of the kind `slack_of`; None where something was missed. latest_l: by
    sensor, in HR steps after k; correction_ms: the longest, from when the measurement
    was taken; both None if no correction landed."""
    released = sum(figures.released for figures in outcome.jobs.values())
    latest = {sensor.name: max(outcome.sensors[sensor.name].achieved, default=None) for sensor in scenario.sensors}
    margins = [(jobs.least_margin, kind) for kind, jobs in outcome.jobs.items() if jobs.least_margin is not None]
    slack, tightest = (None, None) if outcome.misses else min(margins, default=(None, None))
    return {
        "processor": name,
        "fits": outcome.misses == 0,
        "jobs": released,
        "misses": outcome.misses,
        "miss_share": outcome.misses / released,
        "slack": slack,
        "slack_of": tightest,
        "utilization": float(outcome.schedule.utilization),
        "latest_l": latest,
        "correction_ms": {sensor.name: _longest_ms(scenario, sensor, outcome) for sensor in scenario.sensors},
        "reason": None,
    }


def _longest_ms(scenario: Scenario, sensor: Sensor, outcome: Outcome) -> float | None:
    longest = outcome.sensors[sensor.name].longest
    return None if longest is None else float(longest * 1000 / (scenario.hr_hz or 1))


def _flat(row: dict[str, Any], scenario: Scenario) -> dict[str, Any]:
    """A column for each sensor, the same for every processor: correction_ms_gps."""
    columns: dict[str, Any] = {}
    for key, value in row.items():
        if key in OF_SENSORS:
            columns |= {f"{key}_{sensor.name}": (value or {}).get(sensor.name) for sensor in scenario.sensors}
        else:
            columns[key] = value
    return columns


def _in_words(row: dict[str, Any], scenario: Scenario) -> dict[str, Any]:
    known, slack = row["fits"] is not None, row["slack"]
    landed = row["correction_ms"] or {}
    lands = {
        f"{sensor.name} lands, ms": None if landed.get(sensor.name) is None else f"{landed[sensor.name]:.4g}"
        for sensor in scenario.sensors
    }
    return {
        "processor": row["processor"],
        "fits": {True: "yes", False: "no", None: None}[row["fits"]],
        "missed": f"{row['misses']} of {row['jobs']}" if known else None,
        "slack": "none" if row["fits"] is False else None if slack is None else WORDS["slack"][1](slack),
        "tightest job": row["slack_of"],
        "busy": percent(row["utilization"]) if known else None,
        **lands,
    }
