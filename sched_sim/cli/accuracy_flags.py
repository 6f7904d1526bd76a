"""Options of the commands that ask for accuracy: of which model, at which outputs, under which conditions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal, NamedTuple

import typer

from sched_sim.bounds import short
from sched_sim.cli import options as opt
from sched_sim.errors import InputError
from sched_sim.ticks import positive

if TYPE_CHECKING:
    from fractions import Fraction

    from filters.accuracy.shipped import ShippedModel
    from sched_sim.design.stated import Stated
    from studies.selection.sampling import Sampling

ACCURACY = "Accuracy"

MODELS = "ins-gps, ins-rtk, star-tracker, camera"

AnyModel = Annotated[
    str | None,
    typer.Option(
        "--model",
        help=f"{MODELS} (each with its rate, interval, delay and outputs, where none is given), or your own: "
        "package.module:function that returns a System, a System and the state at which it is linearised, or a "
        "LinearModel.",
        rich_help_panel=ACCURACY,
    ),
]
Output = Annotated[
    str | None,
    typer.Option(
        "--output",
        help="The states whose accuracy is asked for, together: position=0:3 (0, 1 and 2), 0,2,5, or the name of an "
        "output of a shipped model, by default its first.",
        rich_help_panel=ACCURACY,
    ),
]
Unit = Annotated[
    str | None,
    typer.Option(
        "--unit", help="Of these outputs, such as m; that of a shipped model is known.", rich_help_panel=ACCURACY
    ),
]
Metric = Annotated[
    Literal["worst", "rms"],
    typer.Option(
        "--metric",
        help="Standard deviation of the worst step of a cycle, or the root of the mean over its steps.",
        rich_help_panel=ACCURACY,
    ),
]
Motion = Annotated[
    str | None,
    typer.Option(
        "--motion",
        help="How fast each measured quantity moves, in its units a second: 15,0,0. fuse-as-fresh is late by that.",
        metavar="NUMBERS",
        rich_help_panel=ACCURACY,
    ),
]
Tau = Annotated[
    str,
    typer.Option(
        "--tau", help="Time constant of px4-predictor, in seconds.", metavar="SECONDS", rich_help_panel=ACCURACY
    ),
]

Every = Annotated[
    str,
    typer.Option(
        "--every",
        help="Use every n-th measurement: 1 (all), 1,2 or 1:4 (end included).",
        metavar="VALUES",
        rich_help_panel=ACCURACY,
    ),
]
AccuracyMethods = Annotated[
    list[str] | None,
    typer.Option(
        "--method",
        help="standard, recalculate, larsen, clone, clone-split, carried-gain, augmentation, dual-rate, "
        "delayed-horizon, px4-predictor, fuse-as-fresh, discard; repeatable; by default all but clone-split and "
        "discard.",
        rich_help_panel=opt.DESIGN,
    ),
]


def every_of(text: str) -> tuple[int, ...]:
    """Raises InputError for what is no whole number, at least 1."""
    from studies.sweep.axes import whole_numbers

    numbers = whole_numbers(text, "--every", at_least=1)
    if len(numbers) > MOST_EVERY:
        raise InputError(f"--every {short(text)} are {len(numbers):,} numbers: give at most {MOST_EVERY}")
    return numbers


MOST_EVERY = 100


ONLY_OF = {
    "tau": ("px4-predictor",),
    "motion": ("fuse-as-fresh",),
    "L": ("dual-rate", "delayed-horizon"),
    "land_within_ms": ("dual-rate", "delayed-horizon"),
    "low_rate_noise": ("dual-rate",),
    "gain": ("dual-rate",),
}
"""Parameters that say nothing of other methods than these."""


def refuse_of_others(context: typer.Context, methods: list[str] | None) -> None:
    """Raises InputError for an option that changes nothing of the methods that were asked for."""
    if not methods:
        return
    useless = {name: of for name, of in ONLY_OF.items() if not set(of) & set(methods)}
    for flag in opt.given_options(context, lambda name: name in useless):
        of = useless[flag.lstrip("-").replace("-", "_")]
        raise InputError(
            f"{flag} changes nothing of --method {', '.join(methods)}: it is for {' and '.join(of)}; leave it out, or "
            f"add --method {of[0]}"
        )


class Sampled(NamedTuple):
    """L: as asked for, in steps; words: what times became in steps, as a note."""

    sampling: Sampling
    L: int | None
    words: str


def sampled(
    shipped: ShippedModel | None,
    N: int | None,
    M: int | None,
    L: int | None,
    hr_hz: str | None,
    measurement_hz: str | None,
    delay_ms: str | None,
    land_within_ms: str | None = None,
) -> Sampled:
    """In steps and in time. Raises InputError for steps and times that do not agree, as the other commands do."""
    from sched_sim.design.stated import Stated
    from studies.selection.sampling import Sampling, with_defaults

    if N is not None and N < 1:
        raise InputError(f"-N is {N}: give at least 1 step between measurements")
    if M is not None and M < 0:
        raise InputError(f"-M is {M}: give 0 or more steps of delay")
    asked = with_defaults(shipped, N, M, hr_hz, measurement_hz, delay_ms)
    rate = None if asked.hr_hz is None else positive(asked.hr_hz, "--hr-hz")
    design = Stated.of(
        asked.N,
        asked.M,
        L,
        rate,
        _text(asked.measurement_hz),
        _text(asked.delay_ms),
        land_within_ms,
    )
    if design.M is None:
        raise InputError("-M is missing: give the delay in HR steps, such as -M 4, or --delay-ms with --hr-hz")
    return Sampled(Sampling.of(None, design.N, design.M, rate, *_held(design)), design.L, design.words)


def _text(value: object) -> str | None:
    return None if value is None else str(value)


def _held(design: Stated) -> tuple[Fraction | None, Fraction | None]:
    """What holds at any rate, of measurements and delay."""
    return (None, None) if design.times is None else (design.times.measurement_hz, design.times.delay_ms)


def shown(sampling: Sampling) -> str:
    """As the title of a table has it."""
    rate = "" if sampling.hr_hz is None else f", HR loop at {float(sampling.hr_hz):g} Hz"
    return f"N={sampling.N} M={sampling.M}{rate}"
