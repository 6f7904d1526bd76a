"""`sched-sim processors`: the processors that are known, and which of them can run a method."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.design_flags import with_options
from sched_sim.cli.instructions import (
    CyclesEach,
    RamKb,
    board_row,
    check_ram,
    in_time_and_ram,
    instructions_note,
    ram_words,
    suited,
)
from sched_sim.cli.less_work import offsets_note
from sched_sim.cli.output import lines, print_csv, print_json, print_table
from sched_sim.cli.parts import MEANING, TASKS_ON_PARTS, highest_note
from sched_sim.cli.refused import Refused
from sched_sim.costs.methods import METHODS
from sched_sim.costs.table import COUNTED
from sched_sim.design.options import Options

if TYPE_CHECKING:
    from fractions import Fraction

    from sched_sim.costs.table import CostTable
    from sched_sim.design.fit import Fit
    from sched_sim.design.pieces import Statistic
    from sched_sim.design.times import Times
    from sched_sim.design.timing import Timing
    from sched_sim.processors.part import Part
    from sched_sim.schedule.tasks import Task

Parts = Annotated[
    list[str] | None,
    typer.Option(
        "--processor",
        help="Repeatable: a shipped one by name, instead of all of them; or your own TOML file by path, beside them.",
        rich_help_panel=opt.PROCESSOR,
    ),
]
Counts = Annotated[
    str | None,
    typer.Option(
        "--costs",
        help="Cost table with counted operations: a shipped one by name, or your own TOML file by path; by default "
        f"{COUNTED} (9 states, 3 inputs, 3 measurements).",
        rich_help_panel=opt.DESIGN,
    ),
]
RunMethods = Annotated[
    list[str] | None,
    typer.Option(
        "--method",
        help=f"The filter to run: {', '.join(METHODS)}; repeatable; by default dual-rate.",
        rich_help_panel=opt.DESIGN,
    ),
]


OneScenario = Annotated[
    Path | None,
    typer.Option(
        "--scenario",
        help="TOML file of a predictor and several sensors, its costs counted: simulated on each part.",
        rich_help_panel=opt.DESIGN,
    ),
]


@with_options
def processors(
    context: typer.Context,
    N: opt.StepsOrNone = None,
    M: opt.Delay = None,
    L: opt.FeedbackStep = None,
    hr_hz: opt.HrHz = None,
    measurement_hz: opt.MeasurementHz = None,
    delay_ms: opt.DelayMs = None,
    land_within_ms: opt.LandWithinMs = None,
    method: RunMethods = None,
    costs: Counts = None,
    statistic: opt.WhichCost = "minimum",
    processor: Parts = None,
    cycles_per_instruction: CyclesEach = None,
    ram_kb: RamKb = None,
    options: Options = Options(),
    tasks: opt.Tasks = None,
    scenario: OneScenario = None,
    format: opt.Format = "table",
) -> None:
    """The processors that are known; with -N and --hr-hz, which of them can run a method, and with how much to spare;
    with --scenario, which of them run it without a miss.

    sched-sim processors
    sched-sim processors -N 40 -M 20 --hr-hz 400 --method dual-rate --gain precomputed
    sched-sim processors --hr-hz 400 --measurement-hz 5 --delay-ms 110 --method larsen --method dual-rate
    sched-sim processors --scenario rocket.toml
    """
    from sched_sim.costs.table_file import load_costs
    from sched_sim.design.stated import Stated
    from sched_sim.errors import InputError
    from sched_sim.processors.part_file import load_part
    from sched_sim.ticks import positive

    if scenario is not None:
        from sched_sim.cli.processors_scenario import verdicts

        if given := opt.given_options(context, lambda name: name not in ("processor", "scenario", "format")):
            raise InputError(
                f"{', '.join(given)} and --scenario {scenario} exclude each other: the file says what is simulated"
            )
        verdicts(scenario, listed(processor or ()), format)
        return
    parts = [load_part(name) for name in listed(processor or ())]
    if not opt.given_options(context, lambda name: name not in OF_THE_LIST):
        rows = [_figures(part) for part in parts]
        shown = [_figures_in_words(part) for part in parts]
        title, note = "Cycles (microseconds where there is no clock) per operation", _titles(parts)
    elif hr_hz is None or (N is None and measurement_hz is None):
        missing = "--hr-hz" if N is not None or measurement_hz is not None else "-N"
        raise InputError(f"{missing} is missing: which processors can run a method depends on -N and --hr-hz")
    else:
        rate = positive(hr_hz, "--hr-hz")
        design = Stated.of(N, M, L, rate, measurement_hz, delay_ms, land_within_ms)
        methods = opt.known_methods(method or ["dual-rate"])
        refused, timings = Refused(methods), {}
        for name in methods:
            with refused.noting(name, design.why_none(name, options)):
                timings[name] = design.timing(name, options)
        others = opt.make_tasks(tasks, "second", rate)
        assert design.times is not None
        counts = load_costs(COUNTED if costs is None else costs)
        check_ram(counts, ram_kb)
        parts = suited(parts, processor or (), counts, cycles_per_instruction)
        rows, shown, remarks = _verdicts(
            parts, timings, counts, statistic, rate, options, others, design.times, refused, ram_kb
        )
        named = ", ".join(name for name in methods if name not in refused.notes)
        what = "operations" if counts.target is None else "instructions"
        title = f"{named}, HR loop at {hr_hz} Hz, {design.shown} ({what}: {costs or COUNTED})"
        same = TASKS_ON_PARTS if others and len(parts) > 1 else ""
        less = offsets_note(timings, others)
        note = lines(MEANING, highest_note(others), less, same, design.words, *remarks)
    if format == "json":
        print_json(rows)
    elif format == "csv":
        print_csv([_flat(row) for row in rows])
    else:
        print_table(title, shown, note)


def listed(named: Sequence[str]) -> list[str]:
    """The shipped ones that are named, all if none is; and the user's own files."""
    from sched_sim.processors.part_file import shipped_parts

    shipped, once = shipped_parts(), list(dict.fromkeys(named))
    chosen = [name for name in once if name in shipped]
    return (chosen or shipped) + [name for name in once if name not in shipped]


def _titles(parts: list[Part]) -> str:
    lines = [f"{part.name}: {part.title}" for part in parts]
    return "\n".join([*lines, "", "logic: instructions around each arithmetic one. Sources: --format json"])


def _flat(row: dict[str, Any]) -> dict[str, Any]:
    """Nested figures as columns of their own, the same for every processor."""
    columns: dict[str, Any] = {}
    for key, value in row.items():
        if isinstance(value, dict):
            names = (*OPERATIONS, *OTHER_FIGURES) if key == "sources" else OPERATIONS
            columns |= {f"{key}_{name}": value.get(name) for name in names}
        else:
            columns[key] = value
    return columns


def _figures(part: Part) -> dict[str, Any]:
    cycles = part.cycles_per_instruction
    return {
        "processor": part.name,
        "title": part.title,
        "precision": part.precision,
        "clock_mhz": None if part.clock_hz is None else float(part.clock_hz / 10**6),
        "seconds": {kind: float(time) for kind, time in part.seconds.items()},
        "logic_per_arithmetic": float(part.logic_per_arithmetic),
        "calibration_least": None if part.calibration is None else float(part.calibration.least),
        "calibration_most": None if part.calibration is None else float(part.calibration.most),
        "calibration_source": None if part.calibration is None else part.calibration.source,
        "sparse_calibration": None if part.sparse_calibration is None else part.sparse_calibration.text,
        "cycles_per_instruction_least": None if cycles is None else float(cycles.least),
        "cycles_per_instruction_most": None if cycles is None else float(cycles.most),
        "cycles_per_instruction_source": None if cycles is None else cycles.source,
        "sources": dict(part.sources),
    }


def _figures_in_words(part: Part) -> dict[str, str | None]:
    scale = part.clock_hz or 10**6
    clock = None if part.clock_hz is None else f"{float(part.clock_hz / 10**6):g}"
    figures = {kind: f"{float(part.seconds[kind] * scale):g}" if kind in part.seconds else None for kind in OPERATIONS}
    return {
        "processor": part.name,
        "precision": part.precision,
        "clock, MHz": clock,
        **figures,
        "logic per arithmetic": f"{float(part.logic_per_arithmetic):.3g}",
    }


OF_THE_LIST = ("processor", "format")
"""The parameters that do not ask which processors can run a method."""

OPERATIONS = ("multiply", "add", "divide", "sqrt", "function", "logic")
OTHER_FIGURES = ("clock_mhz", "logic_per_arithmetic")


def _verdicts(
    parts: Sequence[Part],
    timings: Mapping[str, Timing],
    counts: CostTable,
    statistic: Statistic,
    rate: Fraction,
    options: Options,
    tasks: Sequence[Task],
    times: Times,
    refused: Refused,
    ram_kb: str | None,
) -> tuple[list[dict[str, Any]], list[dict[str, Any]], list[str]]:
    """A row for each processor and method that is not refused; the same in words, in the order of `_by_slack`; and
    remarks: which covariance update the operations are of, the ground, and why some processors cannot be told of."""
    from sched_sim.cli.caveats import caveat_note, with_caveats
    from sched_sim.cli.measured_note import measured_row, say_of_statistic
    from sched_sim.cli.no_time import no_time_note
    from sched_sim.cli.parts import fit_row, fit_words, fixed_by, least_row
    from sched_sim.cli.progress import simulations
    from sched_sim.cli.update_form import form_note, structure_word, update_form
    from sched_sim.design.fit import fit
    from sched_sim.design.methods import select
    from sched_sim.errors import InputError
    from sched_sim.processors.ground import calibration_texts, ground
    from sched_sim.processors.part import on_part, ranged, without_time

    rows, shown = [], []
    lacking: dict[str, list[str]] = {}
    verdicts: list[Fit | None] = []
    tables = [on_part(counts, part) for part in parts]
    calibrations = calibration_texts(counts, parts)
    parts = [ranged(counts, part) for part in parts]
    say_of_statistic(statistic, tables)

    def verdict_of(part: Part, table: CostTable, method: str, timing: Timing) -> tuple[Fit | None, str | None]:
        """And why there is none."""
        try:
            work = select(table, method, options, statistic)
        except InputError as error:
            if method not in table.lacking:
                raise
            missing = [operation for job in counts.operations[method].values() for operation in without_time(job, part)]
            lacking[part.name] = list(dict.fromkeys([*lacking.get(part.name, ()), *missing]))
            return None, str(error)
        with simulations(f"{method} on {part.name}") as on_progress:
            return fit(work, timing, rate, options, tasks, on_progress, times=times), None

    found: dict[tuple[str, str], tuple[Fit | None, str | None]] = {}
    for method, timing in timings.items():
        with refused.noting(method):
            for part, table in zip(parts, tables, strict=True):
                found[part.name, method] = verdict_of(part, table, method, timing)
    refused.say()
    timings = {method: timing for method, timing in timings.items() if method not in refused.notes}
    for part, table in zip(parts, tables, strict=True):
        for method, timing in timings.items():
            verdict, reason = found[part.name, method]
            verdicts.append(verdict)
            least = None if verdict is None else verdict.least
            row = in_time_and_ram(
                least_row(method, timing, least)
                | update_form(counts, method)
                | fit_row(part, rate, times, verdict, bool(tasks))
                | board_row(table, method, ram_kb)
            )
            rows.append(row | measured_row(table, method, timing, options, tasks) | {"reason": reason})
            name = {"method": method} if len(refused.methods) > 1 else {}
            about: dict[str, str | None] = {"processor": part.name, "precision": part.precision, **name}
            about |= structure_word(counts)
            words = fit_words(part, rate, times, verdict, bool(tasks))
            shown.append(about | words | {"fixed by": fixed_by(row["binding"]), **ram_words(row)})
    in_order = sorted(range(len(shown)), key=lambda index: _by_slack(verdicts[index], rows[index]["fits"]))
    return (
        with_caveats(rows),
        [shown[index] for index in in_order],
        [
            caveat_note(timings),
            form_note(counts, timings),
            ground(counts, timings, calibrations),
            no_time_note(lacking),
            instructions_note(counts, rows, *parts),
        ],
    )


def _by_slack(verdict: Fit | None, fits: bool | None) -> tuple[int, Fraction | int]:
    """What fits is first, that with the least slack before the others; then what does not, the nearest first; last what
    is not known."""
    if verdict is None:
        return 2, 0
    return (0, verdict.slack) if fits else (1, verdict.needed)
