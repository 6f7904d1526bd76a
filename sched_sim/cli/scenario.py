"""`sched-sim simulate --scenario`: distributions of response times and of achieved l, and how often deadlines are
missed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from sched_sim import shares
from sched_sim.cli.chart_options import stretch
from sched_sim.cli.output import Format, lines, print_csv, print_json, print_table
from sched_sim.cli.outputs import Named, module_files, refuse_one_file_for_two
from sched_sim.cli.progress import progress_bar
from sched_sim.cli.rare import check_rare, document_of, find_rare, probability_words, rare_columns, show_rare
from sched_sim.cli.scenario_accuracy import (
    Run,
    accuracy_of,
    columns,
    document,
    question,
    show,
    show_slower,
    slower_rows,
    slower_runs,
)
from sched_sim.cli.scenario_exact import exact_document, exact_note, find_exact
from sched_sim.cli.scenario_flags import Asked

if TYPE_CHECKING:
    from sched_sim.scenario.composition import Composition
    from sched_sim.scenario.outcome import JobFigures, Outcome, SensorFigures
    from sched_sim.scenario.scenario import Scenario, Sensor
    from sched_sim.schedule.engine import Engine
    from sched_sim.schedule.outcome import Slice
    from studies.probability.beside_sampled import Beside
    from studies.selection.in_scenario import ScenarioAccuracy


class Picture(NamedTuple):
    """The schedule as a picture: in which file, if any, and the first step and the end that were asked for."""

    path: Path | None
    first: str | None = None
    until: str | None = None


def simulate_scenario(
    path: Path,
    picture: Picture,
    traces: Sequence[Path],
    histogram: Path | None,
    asked: Asked,
    outputs: Named,
    format: Format,
    engine: Engine,
    rare: bool,
) -> None:
    """outputs: the three, by their options. Raises InputError for a scenario that cannot be run, and for a file that
    cannot be written or is one that is read."""
    from sched_sim.scenario.run import run_scenario
    from sched_sim.scenario.scenario_file import read_scenario
    from sched_sim.schedule.trace import check_trace, open_trace

    gantt = picture.path
    if gantt is not None or histogram is not None:
        from reports.drawing.picture import check_picture

        for option, file in (("--gantt", gantt), ("--histogram", histogram)):
            if file is not None:
                check_picture(file, option)
    for trace in traces:
        check_trace(trace)
    scenario, slower = read_scenario(path, describe), asked.slower
    if rare:
        check_rare(scenario)
    about = question(scenario, path, asked)
    steps = None
    if picture.first is not None or picture.until is not None:
        steps = stretch(picture.first, picture.until, scenario.hr_hz, scenario.steps, more="steps in the file")
    read: list[Path | str] = [*scenario.files, *module_files()]
    refuse_one_file_for_two(outputs, [("--scenario", file) for file in read])
    with ExitStack() as files:
        writers = [files.enter_context(open_trace(trace, scenario.hr_hz)) for trace in traces]

        def write(piece: Slice) -> None:
            for writer in writers:
                writer(piece)

        progress = files.enter_context(progress_bar("Simulating"))
        on_slice = write if writers else None
        outcome = run_scenario(scenario, engine=engine, on_slice=on_slice, on_progress=progress)
    accuracy = None if about is None else accuracy_of(about, scenario, outcome)
    exact = "" if format == "csv" and histogram is None else find_exact(scenario)
    if histogram is not None:
        from reports.drawing.picture import save
        from reports.scenario.distributions import distributions_figure

        beside = None if isinstance(exact, str) else exact
        save(distributions_figure(scenario, outcome, accuracy, beside), histogram, "--histogram")
    if gantt is not None:
        from reports.charts.chart import gantt as draw
        from reports.charts.chart import save
        from reports.scenario.panel import scenario_panel

        save(draw([scenario_panel(scenario, outcome, steps)], hr_hz=scenario.hr_hz), gantt, "--gantt")
    busy_shares = [busy / outcome.schedule.horizon for busy in outcome.busy]
    runs: list[Run] = []
    if about is not None and accuracy is not None and slower:
        runs = slower_runs(about, scenario, outcome, accuracy, slower, engine)
    seldom = find_rare(scenario, outcome) if rare else None
    if format == "json":
        more = {} if accuracy is None else {"accuracy": document(accuracy, runs)}
        more |= {} if seldom is None else {"rare": document_of(seldom)}
        print_json(_document(scenario, outcome, busy_shares) | exact_document(exact) | more)
    elif format == "csv":
        rows = _rows(scenario, outcome, accuracy)
        if seldom is not None:
            rows = [row | rare_columns(seldom.get(row["job"])) for row in rows]
        print_csv(slower_rows(runs) or rows)
    else:
        _show(scenario, outcome, busy_shares, exact)
        if seldom is not None:
            show_rare(seldom)
        if accuracy is not None:
            show(accuracy)
        if runs:
            show_slower(runs)


def describe(name: str, folder: Path) -> Composition:
    """Imports the filters only if the file names one."""
    from studies.measurement.described import describe_filter

    return describe_filter(name, folder)


def _document(scenario: Scenario, outcome: Outcome, busy: Sequence[float]) -> dict[str, Any]:
    from sched_sim.scenario.causes import causes
    from sched_sim.scenario.load import demand
    from sched_sim.scenario.said import WITHHELD

    ms = None if scenario.hr_hz is None else float(1000 / scenario.hr_hz)
    return {
        "scenario": scenario.name,
        "steps": scenario.steps,
        "seed": scenario.seed,
        "late": scenario.late,
        "hr_hz": None if scenario.hr_hz is None else float(scenario.hr_hz),
        "speed": float(scenario.speed),
        "speed_exact": str(scenario.speed),
        "misses": outcome.misses,
        "utilization": float(outcome.schedule.utilization),
        "busy": busy,
        "demand": demand(scenario),
        "causes": causes(scenario, outcome, busy),
        "note": WITHHELD if scenario.harness else None,
        "jobs": {kind: _job(figures, ms, scenario.harness) for kind, figures in outcome.jobs.items()},
        "sensors": {sensor.name: _of_sensor(scenario, sensor, outcome) for sensor in scenario.sensors},
    }


def _of_sensor(scenario: Scenario, sensor: Sensor, outcome: Outcome) -> dict[str, Any]:
    """every, and the delays from the step in which a measurement is taken, are in HR steps."""
    hz = None if scenario.hr_hz is None else float(scenario.hr_hz / sensor.every)
    rate = {"every": float(sensor.every), "hz": hz}
    delays = {"least_delay": sensor.least_delay, "longest_delay": sensor.longest_delay}
    return rate | delays | _sensor(sensor, outcome.sensors[sensor.name])


WHY_NOT_RESOLVED = (
    "not resolved: none of n missed; with a P(miss) of 3/n or more one would have, with 95 % (for less: --rare)"
)


def _job(figures: JobFigures, ms: float | None, harness: bool) -> dict[str, Any]:
    """Response times in HR periods, and in ms where a period is so many. harness: see `Scenario`."""
    from sched_sim.scenario.distribution import finished_or_not

    finished = len(figures.responses)
    response = finished_or_not(figures.responses, figures.released - finished) if finished else None
    in_ms = None if response is None or ms is None else {name: _times(ms, value) for name, value in response.items()}
    return {
        "released": figures.released,
        "finished": finished,
        "response_periods": response,
        "response_ms": in_ms,
        "misses": figures.misses,
        "decided": figures.decided,
        "miss_probability": None if harness else figures.miss_probability,
        "miss_interval": None if harness else figures.miss_interval,
    }


def _times(unit: float, value: float | None) -> float | None:
    return None if value is None else unit * value


def _rows(scenario: Scenario, outcome: Outcome, accuracy: ScenarioAccuracy | None) -> list[dict[str, Any]]:
    """Of CSV, one for each kind of job."""
    from sched_sim.scenario.kinds import correct_kind

    rows = [_flat(scenario, kind, figures) for kind, figures in outcome.jobs.items()]
    if accuracy is None:
        return rows
    sensors = {correct_kind(sensor): sensor.name for sensor in scenario.sensors}
    return [row | columns(accuracy, sensors.get(row["job"])) for row in rows]


def _flat(scenario: Scenario, kind: str, figures: JobFigures) -> dict[str, Any]:
    """One row of CSV."""
    from sched_sim.scenario.outcome import QUANTILES

    ms = None if scenario.hr_hz is None else float(1000 / scenario.hr_hz)
    job = _job(figures, ms, scenario.harness)
    least, most = job["miss_interval"] or (None, None)
    units = ("periods",) if ms is None else ("periods", "ms")
    responses = {unit: job[f"response_{unit}"] or dict.fromkeys(QUANTILES) for unit in units}
    return {
        "job": kind,
        "released": job["released"],
        "finished": job["finished"],
        **{f"{name}_{unit}": value for unit, times in responses.items() for name, value in times.items()},
        "misses": job["misses"],
        "decided": job["decided"],
        "miss_probability": job["miss_probability"],
        "miss_probability_least": least,
        "miss_probability_most": most,
    }


def _sensor(sensor: Sensor, figures: SensorFigures) -> dict[str, Any]:
    """achieved_l: shares of all that arrived, so that those which have not landed are what is left to 1."""
    return {
        "taken": figures.taken,
        "dropped": figures.dropped,
        "arrived": figures.arrived,
        "on_the_way": figures.on_the_way,
        "landed": figures.achieved.total(),
        "not_landed": figures.not_landed,
        "land_by": sensor.land_by,
        "achieved_l": {str(L): count / figures.arrived for L, count in sorted(figures.achieved.items())},
    }


def _show(scenario: Scenario, outcome: Outcome, busy: Sequence[float], exact: Beside | str) -> None:
    from sched_sim.scenario.sensor_times import times

    ms = None if scenario.hr_hz is None else float(1000 / scenario.hr_hz)
    rate = f"at {float(scenario.speed):.6g} cost units a step" if ms is None else f"at {float(1000 / ms):g} Hz"
    unit = "HR periods" if ms is None else "ms"
    print_table(
        f"{scenario.name}: {scenario.steps} steps {rate}, late measurements: {scenario.late}; response times in {unit}",
        [_job_words(kind, figures, ms or 1.0, scenario.harness) for kind, figures in outcome.jobs.items()],
        lines(_note(scenario, outcome, busy), exact_note(exact)),
    )
    if outcome.sensors:
        print_table(
            "Measurements, and the step l = k + ... in which their corrections landed",
            [_sensor_words(sensor, outcome.sensors[sensor.name]) for sensor in scenario.sensors],
            "\n".join([_sensor_note(outcome.sensors.values()), *times(scenario)]),
        )


def _note(scenario: Scenario, outcome: Outcome, busy: Sequence[float]) -> str:
    """Below the table: how busy the processors were, what the figures are of, and why deadlines are missed."""
    from sched_sim.scenario.causes import causes
    from sched_sim.scenario.said import INTERVAL, WITHHELD, phases_note

    processors = "Processors" if len(busy) > 1 else "Processor"
    lines = [f"{processors} busy {' and '.join(map(shares.percent, busy))} of the time"]
    if not all(figures.decided for figures in outcome.jobs.values()):
        lines[0] += "; -: nothing to tell it from"
    if any(figures.released > len(figures.responses) for figures in outcome.jobs.values()):
        lines.append(
            "Some jobs have not finished: min, mean and max are of those that have; median, p95 and p99 of all, "
            "- where the unfinished decide"
        )
    if note := phases_note(scenario):
        lines.append(note)
    lines.append(WITHHELD if scenario.harness else INTERVAL)
    if not scenario.harness and any(jobs.decided and not jobs.misses for jobs in outcome.jobs.values()):
        lines.append(WHY_NOT_RESOLVED)
    return "\n".join([*lines, *causes(scenario, outcome, busy)])


def _job_words(kind: str, figures: JobFigures, unit: float, harness: bool) -> dict[str, Any]:
    job = _job(figures, None, harness)
    response = job["response_periods"]
    shown = {"minimum": "min", "mean": "mean", "median": "median", "p95": "p95", "p99": "p99", "maximum": "max"}
    words = {
        "job": kind,
        "jobs": figures.released,
        "finished": len(figures.responses),
        **{
            word: _four_digits(None if response is None else _times(unit, response[name]))
            for name, word in shown.items()
        },
        "missed": figures.misses,
    }
    if harness:
        return words
    if not figures.decided:
        return words | {"P(miss)": None, "95 % interval": None}
    return words | probability_words(figures.miss_probability, figures.miss_interval)


def _four_digits(value: float | None) -> str | None:
    return None if value is None else f"{value:.4g}"


def _sensor_words(sensor: Sensor, figures: SensorFigures) -> dict[str, Any]:
    from sched_sim.scenario.distribution import finished_or_not

    row = _sensor(sensor, figures)
    shown = ("taken", "dropped", "on_the_way", "landed", "not_landed", "land_by")
    words = {"sensor": sensor.name} | {key.replace("_", " "): row[key] for key in shown}
    if not figures.achieved:
        return words | dict.fromkeys(("min", "median", "p95", "max", "most often"))
    achieved = finished_or_not(list(figures.achieved.elements()), figures.not_landed)
    ((often, count),) = figures.achieved.most_common(1)
    return words | {
        "min": achieved["minimum"],
        "median": achieved["median"],
        "p95": achieved["p95"],
        "max": achieved["maximum"],
        "most often": f"{often} ({shares.percent(count / figures.arrived)})",
    }


def _sensor_note(all_figures: Iterable[SensorFigures]) -> str:
    """Below the second table, as `_note` below the first."""
    note = "land by: the last step that meets the deadline"
    if any(figures.not_landed for figures in all_figures):
        note += (
            "\nSome corrections have not landed: min and max are of those that have; median, p95 and the share of the "
            "most often of all that arrived, - where the others decide"
        )
    return note
