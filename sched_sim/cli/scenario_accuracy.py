"""The accuracy along a scenario, as `simulate --scenario` shows it, and what a slower processor costs of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from sched_sim.cli.output import lines, print_table
from sched_sim.cli.progress import progress_bar
from sched_sim.cli.scenario_flags import Asked
from sched_sim.errors import InputError
from sched_sim.shares import percent
from sched_sim.ticks import exact

if TYPE_CHECKING:
    from sched_sim.scenario.outcome import Outcome
    from sched_sim.scenario.scenario import Scenario
    from sched_sim.schedule.engine import Engine
    from studies.selection.in_scenario import Question, ScenarioAccuracy

NAMES = ("median", "p95", "worst")


class Run(NamedTuple):
    """A simulation on a processor `times` as slow as the scenario's, text: as it was given."""

    text: str
    times: float
    outcome: Outcome
    accuracy: ScenarioAccuracy


def question(scenario: Scenario, path: Path, asked: Asked) -> Question | None:
    """What the options or the file ask; None if neither does. Raises InputError for what cannot be."""
    if scenario.accuracy is None and not asked.anything:
        return None
    from studies.selection.in_scenario import question_of

    if scenario.accuracy is None and asked.model is None and asked.output is None:
        raise InputError(
            "--times-slower, --unit and --initial-std are about the accuracy along the scenario: give --model and "
            "--output too, or [accuracy] in its file"
        )
    return question_of(
        scenario, path.parent, model=asked.model, output=asked.output, unit=asked.unit, initial_std=asked.start
    )


def accuracy_of(asked: Question, scenario: Scenario, outcome: Outcome) -> ScenarioAccuracy:
    from studies.selection.in_scenario import accuracy_along

    with progress_bar("Accuracy") as progress:
        return accuracy_along(asked, scenario, outcome, on_progress=progress)


def slower_runs(
    asked: Question,
    scenario: Scenario,
    outcome: Outcome,
    accuracy: ScenarioAccuracy,
    slower: Sequence[tuple[str, float]],
    engine: Engine,
) -> list[Run]:
    """The scenario as it is, then on each processor; with the same draws of delays, dropout and execution times, and
    over the same steps, those that all have figures of."""
    from sched_sim.scenario.run import run_scenario

    runs = [Run("1", 1.0, outcome, accuracy)]
    for text, times in slower:
        other = replace(scenario, speed=scenario.speed / exact(text, "--times-slower"))
        with progress_bar(f"{text} times as slow") as progress:
            found = run_scenario(other, engine=engine, on_progress=progress)
        runs.append(Run(text, times, found, accuracy_of(asked, other, found)))
    together = over_the_same_steps([run.accuracy for run in runs])
    return [run._replace(accuracy=accuracy) for run, accuracy in zip(runs, together, strict=True)]


def over_the_same_steps(several: Sequence[ScenarioAccuracy]) -> list[ScenarioAccuracy]:
    """Those of which all have figures, so that these can be compared. Raises InputError if there are none."""
    first = max((accuracy.first for accuracy in several), default=0)
    last = min((accuracy.last for accuracy in several), default=0)
    if first > last:
        raise InputError(
            f"the accuracy on different processors cannot be compared: on one it has figures from step {first} on, on "
            f"one up to step {last}: simulate more steps, or leave out what is so slow"
        )
    return [accuracy.between(first, last) for accuracy in several]


def verdict_columns(accuracy: ScenarioAccuracy) -> dict[str, Any]:
    """Beside the verdict on a processor, for scripts."""
    outputs = accuracy.question.outputs
    return {"output": outputs.name, "output_unit": outputs.unit or None, **_deviations(accuracy)}


def verdict_words(accuracy: ScenarioAccuracy | None, heading: ScenarioAccuracy) -> dict[str, Any]:
    """The same in the table; accuracy: None where it is not known."""
    unit = heading.question.outputs.unit
    words = dict.fromkeys(NAMES) if accuracy is None else _words(accuracy.spread)
    return {f"{name} std{f', {unit}' if unit else ''}": value for name, value in words.items()}


def document(accuracy: ScenarioAccuracy, runs: Sequence[Run]) -> dict[str, Any]:
    """For JSON. Steps are HR steps; ms only where a rate is known."""
    question = accuracy.question
    ms = None if accuracy.hr_hz is None else float(1000 / accuracy.hr_hz)
    return {
        "model": question.model.name,
        "linearised": question.model.linearised,
        "output": question.outputs.name,
        "unit": question.outputs.unit or None,
        "from_step": accuracy.first,
        "to_step": accuracy.last,
        "from_ms": None if ms is None else ms * accuracy.first,
        **_deviations(accuracy),
        "ages": {sensor: _age(accuracy, sensor) for sensor in accuracy.ages},
        "remarks": list(accuracy.remarks),
        "slower": [slower_row(run, runs[0]) for run in runs[1:]],
    }


def columns(accuracy: ScenarioAccuracy, sensor: str | None) -> dict[str, Any]:
    """For CSV, beside the figures of a job: of its sensor's information, if it is a correction, and of the output."""
    ages = dict.fromkeys(_age_keys(accuracy)) if sensor is None else _age(accuracy, sensor)
    outputs = accuracy.question.outputs
    return {**ages, "output": outputs.name, "unit": outputs.unit or None, **_deviations(accuracy)}


def slower_row(run: Run, first: Run) -> dict[str, Any]:
    """For scripts. over: the share by which it is above that of the first."""
    found, base = run.accuracy, first.accuracy
    over = {f"over_{name}": _over(getattr(found.spread, name), getattr(base.spread, name)) for name in NAMES}
    return {
        "times_slower": run.times,
        "from_step": found.first,
        "misses": run.outcome.misses,
        "utilization": float(run.outcome.schedule.utilization),
        "output": found.question.outputs.name,
        "unit": found.question.outputs.unit or None,
        **_deviations(found),
        **over,
        "ages": {sensor: _age(found, sensor) for sensor in found.ages},
    }


def slower_rows(runs: Sequence[Run]) -> list[dict[str, Any]]:
    """The same for CSV, the ages of each sensor in columns of its own."""
    rows = []
    for run in runs:
        row = slower_row(run, runs[0])
        ages: Mapping[str, Mapping[str, Any]] = row.pop("ages")
        rows.append(row | {f"{sensor} {key}": value for sensor, age in ages.items() for key, value in age.items()})
    return rows


def show(accuracy: ScenarioAccuracy) -> None:
    """The table of the output and of each sensor's information."""
    question, unit = accuracy.question, accuracy.age_unit
    rows = [
        {"quantity": question.outputs.name, "in": question.outputs.unit or None, **_words(accuracy.spread)},
        *({"quantity": f"age of {sensor}", "in": unit, **_words(accuracy.age(sensor))} for sensor in accuracy.ages),
    ]
    print_table(
        f"Standard deviation of {question.outputs.name} along the simulation, and the age of what is in it: "
        f"{question.model.name}",
        rows,
        lines(
            "age: from when a sensor's newest measurement in the output was taken to the start of the step",
            *accuracy.remarks,
        ),
    )


def show_slower(runs: Sequence[Run]) -> None:
    first = runs[0]
    outputs = first.accuracy.question.outputs
    unit = f", {outputs.unit}" if outputs.unit else ""
    rows = []
    for run in runs:
        figures, base = run.accuracy.spread, first.accuracy.spread
        row = {
            "times as slow": run.text,
            "missed": run.outcome.misses,
            "busy": percent(float(run.outcome.schedule.utilization)),
        }
        for name in NAMES:
            row[f"{name}{unit}"] = _four(getattr(figures, name))
            over = _over(getattr(figures, name), getattr(base, name))
            row[f"{name} over"] = None if run is first or over is None else _percent(over)
        for sensor in run.accuracy.ages:
            age = run.accuracy.age(sensor)
            row[f"{sensor} p95 age, {run.accuracy.age_unit}"] = None if age is None else _four(age.p95)
        rows.append(row)
    print_table(
        f"{outputs.name} on a processor so many times as slow",
        rows,
        "\n".join(_sentences(runs)),
    )


def _sentences(runs: Sequence[Run]) -> Iterator[str]:
    """Such as "a processor 2 times as slow costs 6 % of the accuracy of position: ..."."""
    first = runs[0].accuracy
    name = first.question.outputs.name
    yield f"all over steps {first.first} to {first.last}, with the same draws of delays, dropout and execution times"
    for run in runs[1:]:
        overs = {which: _over(getattr(run.accuracy.spread, which), getattr(first.spread, which)) for which in NAMES}
        known = [f"{which} {_percent(over)}" for which, over in overs.items() if over is not None]
        if known:
            more = ", ".join(known)
            yield f"a processor {run.text} times as slow: the standard deviation of {name} is higher by: {more}"


def _deviations(accuracy: ScenarioAccuracy) -> dict[str, float]:
    return {f"{name}_std": getattr(accuracy.spread, name) for name in NAMES}


def _age(accuracy: ScenarioAccuracy, sensor: str) -> dict[str, float | None]:
    age = accuracy.age(sensor)
    keys = _age_keys(accuracy)
    return dict.fromkeys(keys) if age is None else dict(zip(keys, age, strict=True))


def _age_keys(accuracy: ScenarioAccuracy) -> list[str]:
    return [f"age_{name}_{accuracy.age_unit}" for name in NAMES]


def _words(figures: Any) -> dict[str, Any]:
    return {name: None if figures is None else _four(getattr(figures, name)) for name in NAMES}


def _over(value: float, base: float) -> float | None:
    return value / base - 1 if base > 0 else None


def _four(value: float) -> str:
    return f"{value:.4g}"


def _percent(over: float) -> str:
    """Three digits, to a hundredth of a percent; what is many times as much as a factor."""
    if 0 < abs(over) < LEAST:
        return f"less than {100 * LEAST:g} %"
    return f"{1 + over:.4g}-fold" if over >= LARGE else f"{float(f'{100 * over:.2f}'):.3g} %"


LARGE, LEAST = 9.99, 1e-4
