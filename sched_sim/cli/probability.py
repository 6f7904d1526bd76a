"""`sched-sim probability`: how often deadlines are missed, exactly, for random costs."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from sched_sim.cli import cost_flags as flags
from sched_sim.cli import options as opt
from sched_sim.cli.design_flags import with_options
from sched_sim.cli.output import say
from sched_sim.cli.outputs import refuse_one_file_for_two
from sched_sim.cli.progress import progress_bar
from sched_sim.costs.table import SECONDS
from sched_sim.design.options import Options
from sched_sim.errors import InputError
from sched_sim.ticks import positive

if TYPE_CHECKING:
    from sched_sim.costs.table import CostTable
    from sched_sim.processors.part import Part

Speed = Annotated[
    str | None,
    typer.Option(
        "--speed",
        help="Cost units the processor does per HR period; where costs are times, or there is a --processor, --hr-hz "
        "says it.",
        rich_help_panel=opt.PROCESSOR,
    ),
]
FirstCycles = Annotated[
    int,
    typer.Option(
        "--cycles",
        help="So many measurement cycles from the start on; the long run is said too.",
        parser=opt.at_least_one,
        metavar="COUNT",
        rich_help_panel=opt.OUTPUT,
    ),
]
Bins = Annotated[
    int | None,
    typer.Option(
        "--bins",
        help="Round costs to so many parts of an HR period, down for lower and up for upper bounds: faster, and an "
        "interval. By default none where costs are whole ticks of which a period has few.",
        parser=opt.at_least_one,
        metavar="COUNT",
        rich_help_panel=opt.OUTPUT,
    ),
]
Preempted = Annotated[
    bool,
    typer.Option(
        "--preempted",
        help="recalculate corrects in a job of its own, less urgent than HR jobs, and catches up with the steps that "
        "pass meanwhile; by default the HR job of m does it, and holds the next ones up.",
        rich_help_panel=opt.DESIGN,
    ),
]
Histogram = Annotated[
    Path | None,
    typer.Option(
        "--histogram",
        help="Draw the tails on a logarithmic axis, what is not resolved shaded: FILE.svg, .pdf or .png.",
        rich_help_panel=opt.OUTPUT,
    ),
]


@with_options
def probability(
    N: opt.StepsOrNone = None,
    M: opt.Delay = None,
    L: opt.FeedbackStep = None,
    hr_hz: opt.HrHz = None,
    measurement_hz: opt.MeasurementHz = None,
    delay_ms: opt.DelayMs = None,
    land_within_ms: opt.LandWithinMs = None,
    method: opt.OneMethod = "dual-rate",
    speed: Speed = None,
    costs: opt.Costs = None,
    statistic: opt.WhichCost = "minimum",
    processor: opt.OnProcessor = None,
    distributions: flags.Distributions = None,
    cost: flags.CostsOfJobs = None,
    worst: flags.Worst = None,
    delays: flags.Delays = None,
    dropout: flags.Dropout = None,
    preempted: Preempted = False,
    options: Options = Options(),
    tasks: opt.Tasks = None,
    cycles: FirstCycles = 1000,
    bins: Bins = None,
    histogram: Histogram = None,
    format: opt.Format = "table",
) -> None:
    """How often HR deadlines are missed, and in which step corrections land, where costs are random: computed exactly,
    not sampled, so that one miss in 1e9 is found, for the first measurement cycles and in the long run. Each execution
    is independent of all others; samples say what they have not seen, and whether their order speaks against that.

    sched-sim probability -N 10 -M 4 --speed 0.78 --cost lr_update=0.56,0.61:1e-6
    sched-sim probability -N 10 -M 4 --hr-hz 400 --costs my-costs.toml --distributions samples.toml --worst 60us
    sched-sim probability -N 80 --hr-hz 400 --delays 75ms:0.5,100ms:0.4,125ms --dropout 0.1 --processor cortex-m7 \
--method recalculate --cost update=30us:0.999,50us
    """
    from sched_sim.cli import probability_shown as shown
    from sched_sim.design.stated import Stated
    from studies.probability.answer import answer
    from studies.probability.question import Question, stated_and_constant

    if histogram is not None:
        from reports.drawing.picture import check_picture

        check_picture(histogram, "--histogram")
    refuse_one_file_for_two(
        [("--histogram", histogram)],
        [("--costs", costs), ("--distributions", distributions), ("--tasks", tasks), ("--processor", processor)],
    )
    part = opt.make_processor(processor)
    table, rate = opt.costs_on(costs, part), opt.hr_rate(hr_hz)
    late = flags.random_delays(delays, M, delay_ms, rate)
    design = Stated.of(N, M if late is None else int(late.worst), L, rate, measurement_hz, delay_ms, land_within_ms)
    if late is not None and design.L is not None:
        design = design._replace(M=int(late.values[0]))
    timing = design.timing(method, options)
    if late is not None:
        timing = replace(timing, M=min(int(late.values[0]), timing.L))
    stated = flags.stated(distributions, cost, worst, method, table.unit)
    known, constant, pieces = stated_and_constant(table, method, options, stated, statistic)
    asked = Question(
        method=method,
        costs=known,
        constant=constant,
        pieces=pieces,
        timing=timing,
        speed=_speed(speed, rate, table, part),
        options=options,
        tasks=opt.make_tasks(tasks, table.unit, rate),
        delays=late,
        dropout=flags.lost(dropout),
        preempted=preempted,
        cycles=cycles,
        bins=bins,
    )
    with progress_bar("Following, faster with fewer --bins") as progress:
        found = answer(asked, progress)
    about = shown.About(found, table, rate, part, design.words)
    if format == "json":
        shown.print_document(about)
    elif format == "csv":
        shown.print_rows(about)
    else:
        shown.show(about)
    if histogram is not None:
        from reports.drawing.picture import save
        from reports.probability.tails import tails_figure

        save(tails_figure(found, rate), histogram, "--histogram")
        say(f"Wrote {histogram}")


def _speed(speed: str | None, rate: Fraction | None, table: CostTable, part: Part | None) -> Fraction:
    """Cost units per HR period: as given, or where costs are times as many as a period has."""
    if speed is None and rate is not None and table.unit in SECONDS:
        return 1 / rate / SECONDS[table.unit]
    if speed is None:
        raise InputError(
            "--speed is missing: give the cost units that the processor does per HR period, such as --speed 0.78; or "
            "--hr-hz, where costs are times or there is a --processor"
        )
    if part is not None:
        raise InputError(
            f"--speed {speed} and --processor {part.name} exclude each other: a part's speed follows from --hr-hz"
        )
    return positive(speed, "--speed")
