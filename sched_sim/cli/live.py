"""`sched-sim live`: the generated filter as two real-time threads, against the prediction."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.code import Cycle, Delay, InPrecision, OwnSystem
from sched_sim.cli.measure import Inputs, Size, UpdateForm
from sched_sim.cli.measure_filter import SIZES
from sched_sim.cli.output import say
from sched_sim.cli.outputs import refuse_one_file_for_two
from sched_sim.cli.progress import progress_bar
from sched_sim.design.pieces import Statistic
from sched_sim.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from filters.translation.library import Precision
    from studies.board.wanted import Filter
    from studies.live.design import Design
    from studies.live.measure import Measured

LIVE = "Live"
EXIT_CODES = {"agrees": 0, "disagrees": 1, "inconclusive": 3}

AtSpeed = Annotated[
    str,
    typer.Option("--speed", help="Cost units that the simulated processor does per HR period.", rich_help_panel=LIVE),
]
PeriodMs = Annotated[
    str, typer.Option("--period-ms", help="Length of an HR period.", metavar="MS", rich_help_panel=LIVE)
]
HowMany = Annotated[
    int,
    typer.Option(
        "--cycles",
        help="Measurement cycles to compare, after a first that is not; with --staircase at each speed. Fewer than 299 "
        "undisturbed ones never agree.",
        parser=opt.at_least_one,
        metavar="COUNT",
        rich_help_panel=LIVE,
    ),
]
OnCore = Annotated[
    int | None,
    typer.Option(
        "--cpu",
        help="The core, from 0, that both threads run on; by default the last.",
        parser=opt.none_or_more,
        metavar="CORE",
        rich_help_panel=LIVE,
    ),
]
Swapped = Annotated[
    bool,
    typer.Option(
        "--swap-priorities",
        help="LR above HR, which is wrong, to see that it comes out as such.",
        rich_help_panel=LIVE,
    ),
]
GanttFile = Annotated[
    Path | None,
    typer.Option(
        "--gantt",
        help="Draw what ran below what was simulated, one or two cycles of it: FILE.svg, .pdf or .png.",
        rich_help_panel=opt.OUTPUT,
    ),
]
TraceFile = Annotated[
    Path | None,
    typer.Option(
        "--trace",
        help="Every slice of both in ms: FILE.json (Chrome Trace Event, opens in Perfetto) or FILE.csv (CPU 1: "
        "simulated, CPU 2: measured).",
        rich_help_panel=opt.OUTPUT,
    ),
]
HistogramFile = Annotated[
    Path | None,
    typer.Option(
        "--histogram",
        help="Draw achieved l, wake-up latencies and what was taken from cycles: FILE.svg, .pdf or .png.",
        rich_help_panel=opt.OUTPUT,
    ),
]
StaircaseFile = Annotated[
    Path | None,
    typer.Option(
        "--staircase",
        help="Instead of one speed: twelve, through the two steps of the staircase about --speed, and draw what was "
        "predicted and measured: FILE.svg, .pdf or .png.",
        rich_help_panel=opt.OUTPUT,
    ),
]


def live(
    context: typer.Context,
    speed: AtSpeed,
    N: Cycle = 10,
    M: Delay = 4,
    period_ms: PeriodMs = "10",
    cycles: HowMany = 500,
    costs: opt.Costs = None,
    statistic: opt.WhichCost = "minimum",
    states: Size = 9,
    inputs: Inputs = 3,
    measurements: Size = 3,
    system: OwnSystem = None,
    update: UpdateForm = "textbook",
    precision: InPrecision = "double",
    cpu: OnCore = None,
    swap_priorities: Swapped = False,
    gantt: GanttFile = None,
    trace: TraceFile = None,
    histogram: HistogramFile = None,
    staircase: StaircaseFile = None,
    format: opt.Format = "table",
) -> None:
    """Run the dual rate filter that `code` writes as two real-time threads (SCHED_FIFO) on one core, each job for the
    CPU time that its costs say, and compare where corrections land with the prediction. Needs Linux, a C compiler and
    the right to real-time priorities. Exit code 0: agrees, 1: disagrees, 3: inconclusive, for too much was taken from
    the core or the cycles are too few; 2, as of all commands: it could not be run.

    sched-sim live -N 10 -M 4 --speed 0.85 --period-ms 10 --cycles 500 --gantt live.svg --trace live.json
    sched-sim live -N 10 -M 4 --speed 0.85 --staircase staircase.svg --cycles 100
    """
    from sched_sim.cli.live_shown import show_run, show_stairs
    from studies.live.design import check_design
    from studies.live.probe import check_shortest
    from studies.live.program import check_compiler
    from studies.live.rights import check_rights, chosen_core
    from studies.live.stairs import through_two_steps, word_of

    _check_outputs(gantt, trace, histogram, staircase, costs)
    design = _design(N, M, speed, period_ms, cycles, costs, statistic)
    check_shortest(design)
    check_design(design)
    check_rights()
    check_compiler()
    core = chosen_core(cpu)
    if system is not None and (given := opt.given_options(context, lambda name: name in SIZES)):
        raise InputError(f"--system {system!r}: leave out {', '.join(given)}: the system has its own")
    wanted = _filter(system, (states, inputs, measurements), update, precision, N, M)
    designs = [design] if staircase is None else through_two_steps(design)
    runs = _runs(wanted, designs, core, swap_priorities, f"{wanted.said}: cannot run live")
    _draw(runs, swap_priorities, gantt, trace, histogram, staircase)
    if staircase is None:
        word = runs[0].agreement.word
        show_run(runs[0], core, swap_priorities, format)
    else:
        word = word_of(runs)
        show_stairs(runs, word, core, swap_priorities, format)
    if code := EXIT_CODES[word]:
        raise typer.Exit(code)


def _runs(wanted: Filter, designs: Sequence[Design], core: int, swapped: bool, failed: str) -> list[Measured]:
    """One after the other. failed: what is said before what is wrong with the filter."""
    from contextlib import ExitStack

    from studies.live.alone import alone_on
    from studies.live.design import check_design
    from studies.live.measure import measured
    from studies.live.probe import check_resolved, resolution
    from studies.live.program import compiled
    from studies.measurement.user_function import explained

    runs = []
    with ExitStack() as there:
        there.enter_context(alone_on(core))
        progress = there.enter_context(progress_bar("Running"))
        with explained(failed):
            program = there.enter_context(compiled(wanted))
            found = resolution(program, designs[0], core)
        for design in designs:
            check_resolved(found, design, check_design(design))
        for number, design in enumerate(designs):
            progress(number, len(designs), f"speed {float(design.speed):.4g}")
            with explained(failed):
                ran = program.run(design, core, swapped=swapped)
            runs.append(measured(ran, design, check_design(design)))
    return runs


def _check_outputs(
    gantt: Path | None, trace: Path | None, histogram: Path | None, staircase: Path | None, costs: str | None
) -> None:
    from reports.drawing.picture import check_picture
    from sched_sim.schedule.trace import check_trace

    pictures = [("--gantt", gantt), ("--histogram", histogram), ("--staircase", staircase)]
    of_one_run = [name for name, path in [*pictures[:2], ("--trace", trace)] if path is not None]
    if staircase is not None and of_one_run:
        raise InputError(
            f"--staircase {staircase}: leave out {', '.join(of_one_run)}: the staircase is of several speeds, these of "
            f"one"
        )
    refuse_one_file_for_two([*pictures, ("--trace", trace)], [("--costs", costs)])
    for name, path in pictures:
        if path is not None:
            check_picture(path, name)
    if trace is not None:
        check_trace(trace)


def _design(N: int, M: int, speed: str, period_ms: str, cycles: int, costs: str | None, statistic: Statistic) -> Design:
    from sched_sim.cli.measured_note import say_of_statistic
    from sched_sim.design.methods import select
    from sched_sim.design.options import Options
    from sched_sim.ticks import positive
    from studies.live.design import Design, of_dual_rate
    from studies.live.program import check_steps

    pace, period_ns = positive(speed, "--speed"), round(10**6 * positive(period_ms, "--period-ms"))
    check_steps(N, M)
    table = opt.costs_on(costs, None)
    say_of_statistic(statistic, [table])
    return Design(of_dual_rate(select(table, "dual-rate", Options(), statistic)), N, M, pace, period_ns, cycles)


def _filter(
    system: str | None,
    sizes: tuple[int, int, int],
    update: UpdateForm,
    precision: Precision,
    N: int,
    M: int,
) -> Filter:
    import numpy as np

    from filters.systems.example import example_system
    from studies.board.wanted import Filter
    from studies.board.write import check_wanted
    from studies.live.program import steps_of
    from studies.measurement.user_system import load_system

    steps = steps_of(N, M)
    if system is None:
        check_wanted("dual-rate", sizes, steps)
        model, x0 = example_system(*sizes), np.zeros(sizes[0])
        said = "--states {} --inputs {} --measurements {}".format(*sizes)
    else:
        model, x0 = load_system(system)
        said = f"--system {system!r}"
        check_wanted("dual-rate", model[:3], steps)
    return Filter("dual-rate", model, x0, update, precision, steps, said)


def _draw(
    runs: list[Measured],
    swapped: bool,
    gantt: Path | None,
    trace: Path | None,
    histogram: Path | None,
    staircase: Path | None,
) -> None:
    from reports.drawing.picture import save

    run = runs[0]
    if gantt is not None:
        from reports.charts.chart import gantt as draw
        from reports.live.beside import beside_panels, rate_of

        save(draw(beside_panels(run, swapped=swapped), hr_hz=rate_of(run)), gantt, "--gantt")
    if histogram is not None:
        from reports.live.histograms import histograms_figure

        save(histograms_figure(run), histogram, "--histogram")
    if staircase is not None:
        from reports.live.staircase import staircase_figure

        save(staircase_figure(runs), staircase, "--staircase")
    if trace is not None:
        from studies.live.both import write_both

        write_both(run, trace, swapped=swapped)
    for path in (gantt, histogram, staircase, trace):
        if path is not None:
            say(f"Wrote {path}")
