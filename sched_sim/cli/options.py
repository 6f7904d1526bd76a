"""Options that several commands share, and what they mean together."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from sched_sim.bounds import MOST_STEPS, short
from sched_sim.costs.methods import METHODS as NAMES
from sched_sim.costs.methods import Method
from sched_sim.costs.table import COUNTED, PAPERS, SECONDS, CostTable, default_methods
from sched_sim.design.pieces import Statistic
from sched_sim.errors import InputError
from sched_sim.schedule.tasks import Task
from sched_sim.text import did_you_mean
from sched_sim.ticks import positive

if TYPE_CHECKING:
    from sched_sim.design.least_speed import LeastSpeed
    from sched_sim.processors.part import Part

DESIGN = "Design"
PROCESSOR = "Processor"
OUTPUT = "Output"


def whole(text: str) -> int:
    """A whole number; says what was given instead, which typer itself does not."""
    try:
        number = int(text)
    except ValueError:
        raise typer.BadParameter(f"{short(text)!r} is not a whole number, such as 10.") from None
    if abs(number) > MOST_STEPS:
        raise typer.BadParameter(f"{short(number)} is out of bounds: give at most {MOST_STEPS:,}.")
    return number


def at_least_one(text: str) -> int:
    number = whole(text)
    if number < 1:
        raise typer.BadParameter(f"{number} is too small: give at least 1.")
    return number


def none_or_more(text: str) -> int:
    number = whole(text)
    if number < 0:
        raise typer.BadParameter(f"{number} is too small: give at least 0.")
    return number


_STEPS = typer.Option(
    "-N",
    help="HR steps from one measurement to the next; multirate methods: from one gain to the next.",
    parser=whole,
    metavar="STEPS",
    rich_help_panel=DESIGN,
)
StepsOrNone = Annotated[int | None, _STEPS]
Delay = Annotated[
    int | None,
    typer.Option(
        "-M",
        help="Delay of the measurement in HR steps; more than N, so that others are taken before it arrives, with "
        "recalculate, larsen, clone, carried-gain and dual-rate; multirate and robust methods have none.",
        parser=whole,
        metavar="STEPS",
        rich_help_panel=DESIGN,
    ),
]
AnyDelay = Annotated[
    int | None,
    typer.Option(
        "-M",
        help="Delay of the measurement in HR steps, which may be above N: several are on their way then.",
        parser=whole,
        metavar="STEPS",
        rich_help_panel=DESIGN,
    ),
]
FeedbackStep = Annotated[
    int | None,
    typer.Option(
        "-L",
        help="Step by which the correction must land, M < L, or L = M with --feedback same-step; with dual-rate it may "
        "be more than N; by default the step in which the next measurement is taken (M >= N: the first after arrival).",
        parser=whole,
        metavar="STEPS",
        rich_help_panel=DESIGN,
    ),
]
MeasurementHz = Annotated[
    str | None,
    typer.Option(
        "--measurement-hz", help="Rate of the measurements, instead of -N; with --hr-hz.", rich_help_panel=DESIGN
    ),
]
DelayMs = Annotated[
    str | None,
    typer.Option("--delay-ms", help="Delay of the measurement, instead of -M; with --hr-hz.", rich_help_panel=DESIGN),
]
LandWithinMs = Annotated[
    str | None,
    typer.Option(
        "--land-within-ms",
        help="The correction must land so long after the measurement was taken, instead of -L; with --hr-hz.",
        rich_help_panel=DESIGN,
    ),
]
Methods = Annotated[
    list[str] | None,
    typer.Option(
        "--method",
        help=f"{', '.join(NAMES)}; repeatable; by default those for a late measurement that the cost table has.",
        rich_help_panel=DESIGN,
    ),
]
OneMethod = Annotated[Method, typer.Option("--method", help="The filter to run.", rich_help_panel=DESIGN)]
Costs = Annotated[
    str | None,
    typer.Option(
        "--costs",
        help="Cost table: a shipped one by name, or your own TOML file by path; by default steffes2014; with "
        "--processor counted-9-3-3 (9 states, 3 inputs, 3 measurements).",
        rich_help_panel=DESIGN,
    ),
]
WhichCost = Annotated[
    Statistic,
    typer.Option("--statistic", help="Which of a measured cost's figures to plan with.", rich_help_panel=DESIGN),
]
OnProcessor = Annotated[
    str | None,
    typer.Option(
        "--processor",
        help="Turn counted operations into time on this part: a shipped one by name (see `sched-sim processors`), or "
        "your own TOML file by path. Costs are then in seconds.",
        rich_help_panel=PROCESSOR,
    ),
]
Tasks = Annotated[
    Path | None,
    typer.Option(
        "--tasks",
        help="TOML file of your other periodic tasks: \\[\\[task]] name, hz, cost_us, priority; or period in HR "
        "periods, cost in the unit of the cost table; offset, if it is known.",
        rich_help_panel=PROCESSOR,
    ),
]
Speed = Annotated[
    str | None,
    typer.Option(
        "--speed",
        help="Cost units the processor does per HR period; by default the method's least speed, with --processor and "
        "--hr-hz that of the part.",
        rich_help_panel=PROCESSOR,
    ),
]
HrHz = Annotated[
    str | None,
    typer.Option("--hr-hz", help="Rate of the HR loop; adds absolute times and rates.", rich_help_panel=DESIGN),
]
Format = Annotated[
    Literal["table", "json", "csv"],
    typer.Option("--format", help="table for people, json or csv for scripts.", rich_help_panel=OUTPUT),
]
WhichEngine = Annotated[
    Literal["auto", "simpy", "compiled"],
    typer.Option(
        "--engine",
        help="What runs the simulation: simpy, the reference, or machine code with the same outcome, compiled "
        "once in some seconds; auto: for long ones. Traces and charts are of simpy.",
        rich_help_panel=OUTPUT,
    ),
]
Cycles = Annotated[
    int,
    typer.Option(
        "--cycles", help="Measurement cycles to run.", parser=at_least_one, metavar="COUNT", rich_help_panel=OUTPUT
    ),
]


def given_options(context: typer.Context, wanted: Callable[[str], bool]) -> list[str]:
    """How the options are spelled that the user gave, of the parameters whose names are wanted."""
    return [
        parameter.opts[0]
        for parameter in context.command.params
        if wanted(str(parameter.name))
        and (source := context.get_parameter_source(str(parameter.name)))
        and source.name != "DEFAULT"
    ]


def make_tasks(path: Path | None, unit: str, rate: Fraction | None) -> Sequence[Task]:
    """unit: of the cost table."""
    if path is None:
        return ()
    from sched_sim.schedule.task_file import read_tasks

    return read_tasks(path, hr_hz=rate, unit_s=SECONDS.get(unit), cost_unit=unit)


@contextmanager
def naming_tasks(path: Path | None, hr_hz: str | None) -> Iterator[None]:
    """Errors of one task or of all name the file that they are from, and say what an HR period is, neither of which
    what finds them knows."""
    try:
        yield
    except InputError as error:
        said = str(error)
        if path is None or "--tasks " in said or not ("task '" in said or "the tasks " in said):
            raise
        rate = hr_rate(hr_hz)
        period = "" if rate is None or "period" not in said or " ms" in said else f"{float(1000 / rate):.6g} ms"
        raise InputError(f"--tasks {str(path)!r}: {said}{period and f' (an HR period is {period})'}") from None


def hr_rate(text: str | None) -> Fraction | None:
    return None if text is None else positive(text, "--hr-hz")


def costs_on(name: str | None, processor: Part | None) -> CostTable:
    """The cost table of this name or path, in seconds on the processor if there is one."""
    from sched_sim.costs.table_file import load_costs

    if processor is None:
        return load_costs(PAPERS if name is None else name)
    from sched_sim.processors.part import on_part

    return on_part(load_costs(COUNTED if name is None else name), processor)


def make_processor(name: str | None) -> Part | None:
    if name is None:
        return None
    from sched_sim.processors.part_file import load_part

    return load_part(name)


def pace(speed: str | None, rate: Fraction | None, processor: Part | None, least: Callable[[], LeastSpeed]) -> Fraction:
    """The speed to run at: the one that was given, else the processor's own at this rate, else the least."""
    if speed is not None and processor is not None:
        raise InputError(
            f"--speed {speed} and --processor {processor.name} exclude each other: a part's speed follows from --hr-hz"
        )
    if speed is not None:
        return positive(speed, "--speed")
    if processor is not None and rate is not None:
        return 1 / rate
    return least().speed


def wanted_methods(methods: Sequence[str] | None, table: CostTable) -> Sequence[str]:
    """Each method once, in the order given; by default those of the table that are for a delayed measurement."""
    return known_methods(methods) if methods else default_methods(table)


def known_methods(methods: Sequence[str], known: Sequence[str] = NAMES) -> Sequence[str]:
    """Each once; raises InputError for one that is none of the known."""
    for method in methods:
        if method not in known:
            raise InputError(
                f"--method {method!r} is unknown here: {did_you_mean(method, known)}choose from {', '.join(known)}"
            )
    return list(dict.fromkeys(methods))
