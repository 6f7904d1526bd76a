"""`sched-sim accuracy`: what landing later costs at the output, for each method."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from sched_sim.cli import accuracy_flags as flags
from sched_sim.cli import options as opt
from sched_sim.cli.accuracy_shown import show, show_along
from sched_sim.cli.design_flags import with_options
from sched_sim.design.options import Options
from sched_sim.errors import InputError

if TYPE_CHECKING:
    from fractions import Fraction

    from studies.selection.landing import Processor
    from studies.selection.model import Model

Trajectory = Annotated[
    Path | None,
    typer.Option(
        "--trajectory",
        help="CSV file, a row for each step: the states, then the inputs; the System is linearised along it, and the "
        "figures are over its steps.",
        rich_help_panel=flags.ACCURACY,
    ),
]
InitialStd = Annotated[
    str | None,
    typer.Option(
        "--initial-std",
        help="With --trajectory: standard deviation of each state in its first step; by default what they settle to "
        "there.",
        metavar="NUMBERS",
        rich_help_panel=flags.ACCURACY,
    ),
]
Costs = Annotated[
    str | None,
    typer.Option(
        "--costs",
        help="Cost table, shipped or your own file, with --speed or --processor alone; by default with --speed "
        "steffes2014, with --processor the operations of filters of the model's size are counted.",
        rich_help_panel=opt.DESIGN,
    ),
]
Speed = Annotated[
    str | None,
    typer.Option(
        "--speed",
        help="Cost units the processor does per HR period: corrections land as it lets them. Without it and "
        "--processor they land as asked for, and no processor is looked at.",
        rich_help_panel=opt.PROCESSOR,
    ),
]
LandingStep = Annotated[
    int | None,
    typer.Option(
        "-L",
        help="Step in which corrections land that may land later than they arrive (dual-rate, delayed-horizon); by "
        "default the latest before the next measurement.",
        parser=opt.whole,
        metavar="STEPS",
        rich_help_panel=opt.DESIGN,
    ),
]


@with_options
def accuracy(
    context: typer.Context,
    model: flags.AnyModel = None,
    output: flags.Output = None,
    unit: flags.Unit = None,
    N: opt.StepsOrNone = None,
    M: opt.AnyDelay = None,
    L: LandingStep = None,
    hr_hz: opt.HrHz = None,
    measurement_hz: opt.MeasurementHz = None,
    delay_ms: opt.DelayMs = None,
    land_within_ms: opt.LandWithinMs = None,
    method: flags.AccuracyMethods = None,
    every: flags.Every = "1",
    metric: flags.Metric = "worst",
    motion: flags.Motion = None,
    tau: flags.Tau = "0.25",
    trajectory: Trajectory = None,
    initial_std: InitialStd = None,
    speed: Speed = None,
    processor: opt.OnProcessor = None,
    costs: Costs = None,
    statistic: opt.WhichCost = "minimum",
    options: Options = Options(),
    tasks: opt.Tasks = None,
    format: opt.Format = "table",
) -> None:
    """How accurate the output is with each method, exactly: at the worst step and over all, and what the delay, landing
    later and leaving measurements out cost.

    sched-sim accuracy --model ins-gps
    sched-sim accuracy --model ins-gps --every 1:4 --motion 15,0,0 --processor cortex-m4f
    sched-sim accuracy --model mymodule:my_system -N 80 -M 44 --output position=0:3 --unit m --hr-hz 400
    """
    from studies.selection.compare import compared
    from studies.selection.model import load_model, shipped_defaults
    from studies.selection.outputs import outputs_of, rows_of

    if model is None:
        raise InputError(f"--model is missing: give one of {flags.MODELS}, or package.module:function of your own")
    numbers = flags.every_of(every)
    flags.refuse_of_others(context, method)
    _refuse_contradictions(context, L, land_within_ms, speed, processor, trajectory)
    shipped = shipped_defaults(model)
    asked = flags.sampled(shipped, N, M, L, hr_hz, measurement_hz, delay_ms, land_within_ms)
    loaded = load_model(model, asked.sampling.hr_hz)
    runs_on = _processor(loaded, speed, processor, costs, asked.sampling.hr_hz, statistic, options, tasks)
    if trajectory is not None:
        from studies.selection.along import compared_along
        from studies.selection.trajectory import read_trajectory

        path = read_trajectory(trajectory, loaded)
        outputs = rows_of(loaded, output, unit)
        found = compared_along(
            loaded,
            outputs,
            asked.sampling,
            path,
            initial_std=initial_std,
            L=asked.L,
            methods=method,
            every=numbers,
            options=options,
            processor=runs_on,
        )
        show_along(found, asked, format)
        return
    outputs = outputs_of(loaded, output, unit)
    show(
        compared(
            loaded,
            outputs,
            asked.sampling,
            L=asked.L,
            methods=method,
            every=numbers,
            motion=motion,
            tau_s=tau,
            metric=metric,
            options=options,
            processor=runs_on,
        ),
        asked,
        format,
    )


OF_A_SCHEDULE = (
    *("costs", "tasks", "statistic"),
    *(choice.name for choice in fields(Options) if choice.name not in ("low_rate_noise", "feedback")),
)
"""Parameters that say nothing where nothing is scheduled."""


def _refuse_contradictions(
    context: typer.Context,
    L: int | None,
    land_within_ms: str | None,
    speed: str | None,
    processor: str | None,
    trajectory: Path | None,
) -> None:
    lands = f"-L {L}" if L is not None else f"--land-within-ms {land_within_ms}"
    paces = [f"--speed {speed}"] * (speed is not None) + [f"--processor {processor}"] * (processor is not None)
    if paces and (L is not None or land_within_ms is not None):
        raise InputError(
            f"{lands} and {paces[0]} exclude each other: where corrections land follows from the processor; leave one "
            f"out"
        )
    if len(paces) == 2:
        raise InputError(f"{paces[0]} and {paces[1]} exclude each other: a part's speed follows from --hr-hz")
    if not paces:
        given = opt.given_options(context, lambda name: name in OF_A_SCHEDULE)
        if given:
            raise InputError(f"{', '.join(given)} without --speed or --processor: give one, or leave it out")
    if trajectory is None:
        given = opt.given_options(context, lambda name: name == "initial_std")
        if given:
            raise InputError(
                "--initial-std without --trajectory: without one, the covariance is what it settles to; give "
                "--trajectory FILE.csv, or leave --initial-std out"
            )
    else:
        given = opt.given_options(context, lambda name: name in ("motion", "tau", "metric", "low_rate_noise"))
        if given:
            raise InputError(
                f"{', '.join(given)} and --trajectory exclude each other: along one there are methods that lose "
                f"nothing, and median, 95 % and worst of the steps"
            )


def _processor(
    model: Model,
    speed: str | None,
    processor: str | None,
    costs: str | None,
    rate: Fraction | None,
    statistic: Any,
    options: Options,
    tasks: Path | None,
) -> Processor | None:
    from sched_sim.cli.output import say
    from sched_sim.cli.update_form import counted_note
    from sched_sim.processors.part import on_part
    from sched_sim.ticks import positive
    from studies.selection.costs import tables_for
    from studies.selection.landing import Processor

    if speed is None and processor is None:
        return None
    part = opt.make_processor(processor)
    if part is not None and rate is None:
        raise InputError(f"--processor {processor} without --hr-hz: give the rate of the HR loop, such as --hr-hz 400")
    if part is not None and rate is not None:
        (counts,) = tables_for(model, costs and [costs], ("textbook",))
        table, pace, shown = on_part(counts, part), 1 / rate, part.name
    else:
        table = opt.costs_on(costs, None)
        pace, shown = positive(speed or "", "--speed"), f"a processor of speed {speed}"
    for note in counted_note(table).splitlines():
        say(f"Note: {note}")
    return Processor(table, pace, shown, options, statistic, opt.make_tasks(tasks, table.unit, rate))
