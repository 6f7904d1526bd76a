"""Options of a Gantt chart: how wide it is, and which of the simulated steps it shows."""

from __future__ import annotations

from fractions import Fraction
from math import ceil, floor
from typing import Annotated

import typer

from sched_sim.bounds import short
from sched_sim.cli import options as opt
from sched_sim.errors import InputError
from sched_sim.ticks import exact

Width = Annotated[
    str,
    typer.Option(
        "--width",
        help="Of the picture: 88mm, 3.5in or a plain number of mm, from 50 to 1000. It is laid out for it; fonts keep "
        "their size.",
        metavar="LENGTH",
        rich_help_panel=opt.OUTPUT,
    ),
]
From = Annotated[
    str | None,
    typer.Option(
        "--from",
        help="First step shown; with --hr-hz also a time, 10ms: the step in which it is.",
        metavar="STEP",
        rich_help_panel=opt.OUTPUT,
    ),
]
Until = Annotated[
    str | None,
    typer.Option(
        "--until",
        help="Step at whose start the picture ends; with --hr-hz also a time, 20ms: the first step that starts then or "
        "after it.",
        metavar="STEP",
        rich_help_panel=opt.OUTPUT,
    ),
]

MM_PER_UNIT = {"mm": Fraction(1), "in": Fraction("25.4")}


def width_mm(text: str) -> float:
    """A length in mm. Raises InputError for what is none, and for one of which no picture is."""
    from reports.charts.chart import NARROWEST_MM, WIDEST_MM

    written = text.strip()
    unit = next((unit for unit in MM_PER_UNIT if written.endswith(unit)), "")
    try:
        width = exact(written.removesuffix(unit), "--width") * MM_PER_UNIT.get(unit, 1)
    except InputError:
        raise InputError(
            f"--width {short(text)!r} is no length: give millimetres or inches, such as 88mm or 3.5in"
        ) from None
    if not NARROWEST_MM <= width <= WIDEST_MM:
        beyond = "narrower" if width < NARROWEST_MM else "wider"
        raise InputError(
            f"--width {short(text)} is {beyond} than a picture can be: give from {NARROWEST_MM}mm to {WIDEST_MM}mm"
        )
    return float(width)


def stretch(
    first: str | None, until: str | None, rate: Fraction | None, steps: int, more: str = "--cycles"
) -> tuple[int, int]:
    """The first step shown, and the one at whose start the picture ends; by default all of the `steps` simulated. A
    time is widened to whole steps.

    rate: of the HR loop, in Hz; more: what lengthens the simulation. Raises InputError for what is no step, for an
    order that is none, and for steps that are not simulated.
    """
    start = 0 if first is None else floor(_step(first, "--from", rate))
    end = steps if until is None else ceil(_step(until, "--until", rate))
    for what, text, beyond in (("--from", first, start >= steps), ("--until", until, end > steps)):
        if beyond:
            lasting = "" if rate is None else f", {float(1000 * steps / rate):g} ms,"
            raise InputError(
                f"{what} {text} is beyond the end: {steps} steps{lasting} are simulated; give an earlier one, or more "
                f"{more}"
            )
    if start >= end:
        after = "the start" if first is None else f"--from {first}"
        raise InputError(f"--until {until} is not after {after}: give a later one")
    return start, end


def _step(text: str, what: str, rate: Fraction | None) -> Fraction:
    """The instant in HR periods."""
    written = text.strip()
    if written.endswith("ms"):
        if rate is None:
            raise InputError(f"{what} {short(text)} is a time: give --hr-hz too, or a step such as 10")
        instant = _number(written.removesuffix("ms"), text, what) * rate / 1000
    else:
        instant = _number(written, text, what)
        if instant.denominator != 1:
            raise InputError(f"{what} {short(text)} is no whole step: give one such as 10, or with --hr-hz 10ms")
    if instant < 0:
        raise InputError(f"{what} {short(text)} is before the first step: give 0 or later")
    return instant


def _number(written: str, text: str, what: str) -> Fraction:
    try:
        return exact(written, what)
    except InputError:
        raise InputError(f"{what} {short(text)!r} is no step: give one such as 10, or with --hr-hz 10ms") from None
