"""`sched-sim sweep`: a grid of designs, each analysed and, if asked for, simulated."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.accuracy_flags import ACCURACY, Output
from sched_sim.cli.design_flags import Axes, with_axes
from sched_sim.cli.output import say
from sched_sim.cli.outputs import refuse_one_file_for_two
from sched_sim.cli.sweep_progress import points_bar
from sched_sim.cli.sweep_shown import report, say_of_no_accuracy, say_of_sizes
from sched_sim.costs.table import COUNTED, PAPERS
from sched_sim.design.pieces import Statistic
from sched_sim.errors import InputError
from sched_sim.schedule.engine import Engine

if TYPE_CHECKING:
    from studies.sweep.dispatch import Compute
    from studies.sweep.run import Sweep

MOST_WORKERS = 1_000


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
        say_of_sizes(asked.grid.accuracy.linear.states, asked.grid.tables)
        say_of_no_accuracy(asked.grid.accuracy, asked.grid.methods)
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
            with points_bar(asked.grid.size) as show:
                outcome = run(asked, store, compute, show)
            if outcome.stopped is None:
                for file in exports:
                    write(store, file)
                report(asked, store, outcome, exports, format)
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
