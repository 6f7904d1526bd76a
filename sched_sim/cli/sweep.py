"""`sched-sim sweep`: a grid of designs, each analysed and, if asked for, simulated."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.accuracy_flags import ACCURACY, Output
from sched_sim.cli.design_flags import Axes, with_axes
from sched_sim.cli.output import lines, print_csv, print_json, print_table, say
from sched_sim.cli.outputs import refuse_one_file_for_two
from sched_sim.cli.parts import HIGHEST_HR_HZ, TASKS_ON_PARTS, WORDS
from sched_sim.costs.table import COUNTED, PAPERS
from sched_sim.design.pieces import Statistic
from sched_sim.errors import InputError
from sched_sim.schedule.engine import Engine

if TYPE_CHECKING:
    from sched_sim.costs.table import CostTable
    from studies.sweep.accuracy import OutputAccuracy
    from studies.sweep.dispatch import Compute
    from studies.sweep.run import Outcome, Sweep
    from studies.sweep.store import Store

MOST_WORKERS = 1_000
SHOWN = 20
"""Rows of the table of best designs that people see; JSON and CSV have them all."""


def _values(flag: str, text: str, panel: str = opt.DESIGN) -> Any:
    return typer.Option(flag, help=text, rich_help_panel=panel, metavar="VALUES")


Axis = list[str] | None
GridFile = Annotated[
    Path | None,
    typer.Argument(
        help="TOML file with the options under Design and Processor, simulate, cycles and engine as keys "
        "(- becomes _); flags take precedence.",
        metavar="GRID",
    ),
]
Ns = Annotated[Axis, _values("-N", "HR steps between measurements: 10 or 1,2,5 or 10:90:10 (end included).")]
Ms = Annotated[
    Axis,
    _values("-M", "Delay of the measurement in HR steps; by default all up to N."),
]
Ls = Annotated[Axis, _values("-L", "Step by which the correction must land; by default all that are legal.")]
MethodNames = Annotated[Axis, _values("--method", "Repeatable; by default those for a delayed measurement.")]
Tables = Annotated[
    Axis,
    _values(
        "--costs",
        f"Cost table, shipped or your own file; by default {PAPERS}, with --processor {COUNTED}. Repeatable.",
    ),
]
WhichCost = Annotated[
    Statistic | None,
    typer.Option("--statistic", help="Which of a measured cost's figures to plan with.", rich_help_panel=opt.DESIGN),
]
Speeds = Annotated[
    Axis,
    _values("--speed", "Cost units per HR period: 0.6:1.6:0.05; by default each design's least.", opt.PROCESSOR),
]
Processors = Annotated[
    Axis,
    _values(
        "--processor",
        "Turn counted operations into seconds on this part: a shipped one by name (see `sched-sim processors`), or "
        "your own TOML file by path. Its speed follows from --hr-hz. Repeatable.",
        opt.PROCESSOR,
    ),
]
HrRates = Annotated[
    Axis,
    _values(
        "--hr-hz",
        "Rates of the HR loop, where costs are in seconds: 100:800:100; by default each design's highest.",
        opt.PROCESSOR,
    ),
]
AccuracyModel = Annotated[
    str | None,
    typer.Option(
        "--model",
        help="Adds the columns worst_std and rms_std, how accurate each design's output is where it lands: ins-gps, "
        "ins-rtk, star-tracker, camera, or package.module:function as in `sched-sim accuracy`. px4-predictor: "
        "with a time constant of 0.25 s.",
        rich_help_panel=ACCURACY,
    ),
]
Simulate = Annotated[
    bool | None,
    typer.Option("--simulate/--no-simulate", help="Simulate every point too.", rich_help_panel=opt.OUTPUT),
]
Cycles = Annotated[
    int | None,
    typer.Option("--cycles", min=1, help="Measurement cycles to simulate; by default 3.", rich_help_panel=opt.OUTPUT),
]
Engines = Annotated[
    Engine | None,
    typer.Option(
        "--engine",
        help="What simulates: simpy, the reference, or machine code with the same rows, compiled once in some seconds; "
        "by default (auto) that where there is much to simulate.",
        rich_help_panel=opt.OUTPUT,
    ),
]
ResultsFile = Annotated[
    Path | None,
    typer.Option(
        "--results",
        help="SQLite file for the rows; the same sweep again goes on where it ended. By default named after the sweep.",
        rich_help_panel=opt.OUTPUT,
    ),
]
Exports = Annotated[
    list[Path] | None,
    typer.Option(
        "--export", help="Write all rows to FILE.csv or FILE.parquet. Repeatable.", rich_help_panel=opt.OUTPUT
    ),
]
Workers = Annotated[
    int | None,
    typer.Option(
        "--workers",
        min=1,
        max=MOST_WORKERS,
        help="Processes that simulate; by default one for each core.",
        rich_help_panel=opt.OUTPUT,
    ),
]
Dask = Annotated[
    str | None,
    typer.Option(
        "--dask",
        help="Simulate on the workers of this Dask scheduler, tcp://HOST:PORT or tls://HOST:PORT, in place of "
        '--workers. Needs the extra: pip install "sched-sim\\[cluster]".',
        rich_help_panel=opt.OUTPUT,
        metavar="ADDRESS",
    ),
]


@with_axes
def sweep(
    grid: GridFile = None,
    N: Ns = None,
    M: Ms = None,
    L: Ls = None,
    speed: Speeds = None,
    method: MethodNames = None,
    costs: Tables = None,
    statistic: WhichCost = None,
    options: Axes = MappingProxyType({}),
    processor: Processors = None,
    hr_hz: HrRates = None,
    tasks: opt.Tasks = None,
    model: AccuracyModel = None,
    output: Output = None,
    simulate: Simulate = None,
    cycles: Cycles = None,
    engine: Engines = None,
    results: ResultsFile = None,
    export: Exports = None,
    workers: Workers = None,
    dask: Dask = None,
    format: opt.Format = "table",
) -> None:
    """Analyse a whole grid of designs, and simulate it with --simulate; all cores, and it resumes after any stop.

    sched-sim sweep -N 10:90:10 -M 1:4 --speed 0.6:1.6:0.05 --export designs.csv
    sched-sim sweep -N 40 -M 20 --processor cortex-m4f --processor leon3 --hr-hz 100:800:100 --tasks tasks.toml
    sched-sim sweep grid.toml --simulate --results designs.sqlite
    """
    from sched_sim.cli.measured_note import say_of_statistic
    from studies.sweep.export import check_export
    from studies.sweep.export import export as write
    from studies.sweep.run import Outcome, run
    from studies.sweep.settings import settings

    flags = {
        "N": N,
        "M": M,
        "L": L,
        "speed": speed,
        "method": method,
        "costs": costs,
        "statistic": statistic,
        **options,
        "processor": processor,
        "hr_hz": hr_hz,
        "tasks": tasks,
        "model": model,
        "output": output,
        "simulate": simulate,
        "cycles": cycles,
        "engine": engine,
    }
    wanted = settings(flags, grid)
    asked = wanted.sweep()
    say_of_statistic(asked.grid.statistic, asked.grid.tables)
    for refused, reason in asked.grid.refused.items():
        say(f"Note: no {refused}: {reason}")
    if asked.grid.accuracy is not None:
        _say_of_sizes(asked.grid.accuracy.linear.states, asked.grid.tables)
        _say_of_no_accuracy(asked.grid.accuracy, asked.grid.methods)
    path = results or Path(f"{grid.stem if grid else 'sweep'}-{asked.digest[:8]}.sqlite")
    exports = export or []
    for file in exports:
        check_export(file)
    refuse_one_file_for_two(
        [("--results", path), *(("--export", file) for file in exports)],
        [
            ("GRID", grid),
            *(("--costs", name) for name in wanted.costs),
            *(("--processor", name) for name in wanted.processor),
            ("--tasks", wanted.tasks),
        ],
    )
    with _simulating(asked, workers, dask) as compute, asked.open(path) as store:
        try:
            with _progress(asked.grid.size) as show:
                outcome = run(asked, store, compute, show)
            if outcome.stopped is None:
                for file in exports:
                    write(store, file)
                _report(asked, store, outcome, exports, format)
        except KeyboardInterrupt:  # while exporting
            outcome = Outcome(store.count(), 0, signal.SIGINT)
        if outcome.stopped is not None:
            kept = outcome.before + outcome.computed
            name = signal.Signals(outcome.stopped).name
            say(
                f"Stopped by {name}: {kept} of {asked.grid.size} points are kept in {path}; "
                f"the same command again goes on from there."
            )
            raise typer.Exit(128 + outcome.stopped)


@contextmanager
def _simulating(asked: Sweep, workers: int | None, dask: str | None) -> Iterator[Compute]:
    """Who does: processes of this machine, or the workers of a scheduler."""
    from studies.sweep.workers import processes

    if dask is None:
        yield processes(workers or _cores())
        return
    if workers is not None:
        raise InputError("--workers is for this machine's processes, and --dask has workers of its own: leave one out")
    from studies.sweep.scheduler import cluster

    with cluster(dask, asked) as compute:
        yield compute


def _cores() -> int:
    """Those that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def _progress(total: int) -> Iterator[Callable[[int], None]]:
    """A bar with rate and time left on a terminal; nothing anywhere else."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, Task, TimeRemainingColumn
    from rich.text import Text

    class Rate(ProgressColumn):
        """Points per second."""

        def render(self, task: Task) -> Text:
            return Text("" if task.speed is None else f"{task.speed:,.0f} points/s")

    with Progress(
        BarColumn(), MofNCompleteColumn(), Rate(), TimeRemainingColumn(), console=Console(stderr=True), transient=True
    ) as bar:
        task = bar.add_task("", total=total)
        known = False

        def show(done: int) -> None:
            nonlocal known
            if not known:  # what was there already says nothing about the rate
                bar.reset(task, completed=done, total=total)
            bar.update(task, completed=done)
            known = True

        yield show


def _say_of_sizes(states: int, tables: Sequence[CostTable]) -> None:
    """Whether the costs are of a filter of another size than the model."""
    for table in tables:
        counted = table.provenance.get("states")
        if counted not in (None, states):
            say(
                f"Note: the costs of {table.name} are of {counted} states, and --model has {states}: give --costs of "
                f"its size, as `sched-sim measure --backend counted` writes them"
            )


def _say_of_no_accuracy(accuracy: OutputAccuracy, methods: Sequence[str]) -> None:
    """Why there are methods whose accuracy is left empty."""
    from studies.selection.methods import by_reason

    for words in by_reason((method, accuracy.lacks(method)) for method in methods):
        say(f"Note: worst_std and rms_std are empty of {words}")


def _report(asked: Sweep, store: Store, outcome: Outcome, exports: Sequence[Path], format: opt.Format) -> None:
    from sched_sim.cli.caveats import caveat_note
    from sched_sim.cli.less_work import offsets_note
    from sched_sim.cli.measured_note import busy_note, busy_row
    from sched_sim.cli.update_form import form_note
    from studies.sweep.summary import best, by_method

    tables = asked.grid.tables
    left = [method for method in asked.grid.methods if method not in asked.grid.refused]
    designs, methods = best(store), by_method(store)
    if format != "table":
        busy = {table.name: busy_row(table.provenance) for table in tables}
        designs, methods = ([row | busy[row["costs"]] for row in rows] for rows in (designs, methods))
    if format == "csv":
        print_csv(designs)
        return
    if format == "json":
        print_json(
            {
                "points": asked.grid.size,
                "left_out": asked.grid.left_out,
                "computed": outcome.computed,
                "results": str(store.path),
                "exports": [str(file) for file in exports],
                "update_form": {table.name: form for table in tables if (form := table.update_form)},
                "structure": {table.name: structure for table in tables if (structure := table.structure)},
                "methods": methods,
                "best": designs,
            }
        )
        return
    left_out = f", {asked.grid.left_out} combinations left out as not legal" if asked.grid.left_out else ""
    before = f" ({outcome.before} of them were there before)" if outcome.before else ""
    several, in_seconds = len(tables) > 1, all(table.unit == "second" for table in tables)
    notes = {lines(form_note(table, left), busy_note(table.provenance)): table.name for table in tables}
    accuracy = asked.grid.accuracy is not None and not exports
    forms = [note if len(notes) == 1 else f"{name}: {note}" for note, name in notes.items() if note]
    print_table(
        f"{asked.grid.size} points{before}{left_out}", [_for_people(row, several, in_seconds) for row in methods]
    )
    more = f"; the first {SHOWN} of {len(designs)} (all: --format json or csv)" if len(designs) > SHOWN else ""
    print_table(
        f"Slowest processor that will do, for each N and M{more}",
        [_for_people(row, several, in_seconds) for row in designs[:SHOWN]],
        note=lines(
            "All rows: " + ", ".join(str(file) for file in (store.path, *exports)),
            "worst_std and rms_std of each design are in these rows; --export FILE.csv writes them" if accuracy else "",
            TASKS_ON_PARTS if asked.grid.tasks and len({table.processor for table in tables}) > 1 else "",
            caveat_note(left),
            offsets_note(left, asked.grid.tasks),
            *forms,
        ),
    )


HEADINGS = {
    "feasible": "meet all deadlines",
    "lowest_min_speed": "least speed from",
    "highest_min_speed": "to",
    "min_speed": "least speed",
    "min_speed_exact": "exactly",
    "highest_hr_hz": f"{HIGHEST_HR_HZ}, same N, M, L",
    "binding": "fixed by",
}


FORMATS = {"highest_hr_hz": WORDS[HIGHEST_HR_HZ][1]}


def _for_people(row: dict[str, Any], several_tables: bool, in_seconds: bool) -> dict[str, Any]:
    """Without what the title or the name of the cost table says; seconds per HR period as microseconds."""
    left_out = {"processor" if several_tables else "costs", *(["min_speed_exact"] if in_seconds else [])}
    shown = {}
    for key, value in row.items():
        heading = HEADINGS.get(key, key.replace("_", " "))
        if in_seconds and key in ("lowest_min_speed", "highest_min_speed", "min_speed"):
            heading, value = f"{heading}, us", 1e6 * value
        if key not in left_out:
            shown[heading] = FORMATS.get(key, "{:.6g}".format)(value) if isinstance(value, float) else value
    return shown
