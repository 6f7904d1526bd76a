"""`sched-sim processors --scenario`: on which parts a scenario misses nothing, by simulation."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sched_sim.cli.output import Format, lines, print_csv, print_json, print_table
from sched_sim.cli.progress import progress_bar
from sched_sim.cli.scenario import describe, phases_note
from sched_sim.errors import InputError
from sched_sim.shares import percent

if TYPE_CHECKING:
    from sched_sim.scenario.run import Outcome
    from sched_sim.scenario.scenario import Scenario, Sensor


def verdicts(path: Path, processors: Sequence[str], format: Format) -> None:
    """Prints a row for each: what misses nothing first, with the busiest of them at the top. Raises InputError if the
    scenario cannot be read for any of them."""
    from sched_sim.processors.part_file import load_part
    from sched_sim.scenario.run import run_scenario
    from sched_sim.scenario.scenario_file import read_scenario

    for name in processors:
        load_part(name)
    rows: list[dict[str, Any]] = []
    reasons: list[str] = []
    scenario: Scenario | None = None
    for name in processors:
        try:
            scenario = read_scenario(path, describe, processor=name)
        except InputError as error:
            if len(processors) == 1:
                raise
            rows.append(dict.fromkeys(KEYS) | {"processor": name, "reason": str(error)})
            reasons.append(f"{name}: {error}")
            continue
        with progress_bar(f"On {name}") as progress:
            rows.append(_row(name, scenario, run_scenario(scenario, on_progress=progress)))
    if scenario is None:
        raise InputError(reasons[0].partition(": ")[2])
    rows.sort(
        key=lambda row: (row["fits"] is None, row["fits"] is False, row["miss_share"], -(row["utilization"] or 0))
    )
    if format == "json":
        print_json(rows)
    elif format == "csv":
        print_csv(
            [{key: value for key, value in row.items() if key not in ("latest_l", "correction_ms")} for row in rows]
        )
    else:
        title = f"{scenario.name}: {scenario.steps} steps at {float(scenario.hr_hz or 0):g} Hz, seed {scenario.seed}"
        missed = f"fits: nothing was missed in these {scenario.steps} steps"
        note = f"{missed}; lands: the latest of each sensor, from when the measurement is taken"
        print_table(title, [_in_words(row, scenario) for row in rows], lines(note, phases_note(scenario), *reasons))


KEYS = ("processor", "fits", "jobs", "misses", "miss_share", "utilization", "latest_l",
        "correction_ms", "reason")  # fmt: skip


def _row(name: str, scenario: Scenario, outcome: Outcome) -> dict[str, Any]:
    """latest_l: by sensor, in HR steps after k; correction_ms: the longest, from when the measurement was taken;
    both None if no correction landed."""
    released = sum(figures.released for figures in outcome.jobs.values())
    latest = {sensor.name: max(outcome.sensors[sensor.name].achieved, default=None) for sensor in scenario.sensors}
    return {
        "processor": name,
        "fits": outcome.misses == 0,
        "jobs": released,
        "misses": outcome.misses,
        "miss_share": outcome.misses / released,
        "utilization": float(outcome.schedule.utilization),
        "latest_l": latest,
        "correction_ms": {sensor.name: _longest_ms(scenario, sensor, outcome) for sensor in scenario.sensors},
        "reason": None,
    }


def _longest_ms(scenario: Scenario, sensor: Sensor, outcome: Outcome) -> float | None:
    longest = outcome.sensors[sensor.name].longest
    return None if longest is None else float(longest * 1000 / (scenario.hr_hz or 1))


def _in_words(row: dict[str, Any], scenario: Scenario) -> dict[str, Any]:
    known = row["fits"] is not None
    landed = row["correction_ms"] or {}
    lands = {
        f"{sensor.name} lands, ms": None if landed.get(sensor.name) is None else f"{landed[sensor.name]:.4g}"
        for sensor in scenario.sensors
    }
    return {
        "processor": row["processor"],
        "fits": {True: "yes", False: "no", None: None}[row["fits"]],
        "missed": f"{row['misses']} of {row['jobs']}" if known else None,
        "busy": percent(row["utilization"]) if known else None,
        **lands,
    }
