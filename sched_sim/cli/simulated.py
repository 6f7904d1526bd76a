"""What a simulation of one filter's jobs came to: for scripts, with units in the names of the keys, and in words."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from sched_sim.cli.output import lines, print_table
from sched_sim.rounding import no_less
from sched_sim.shares import percent

if TYPE_CHECKING:
    from sched_sim.design.timing import Timing
    from sched_sim.processors.part import Part
    from sched_sim.schedule.outcome import Response, Schedule

Achieved = Sequence[int | None]
"""By cycle, the steps from a measurement to where its correction landed; None if not within the simulated time."""


def of_run(
    method: str, timing: Timing, speed: Fraction, unit: str, rate: Fraction | None, part: Part | None
) -> dict[str, Any]:
    """What was simulated. speed: in units of cost (`unit`) per HR period; rate: in Hz."""
    about = {
        "method": method,
        "N": timing.N,
        "M": timing.M,
        "L": timing.L,
        "speed": float(speed),
        "speed_exact": str(speed),
        "cost_unit": unit,
    }
    on = {} if part is None else {"processor": part.name}
    return about | on | ({} if rate is None else {"hr_hz": float(rate)})


def outcome(schedule: Schedule, achieved: Achieved, rate: Fraction | None, wait: Fraction) -> dict[str, Any]:
    """achieved_l in HR steps after k, correction_ms in ms from when the measurement is taken, at the latest: wait steps
    before k; utilization: a share of the time."""
    landed: dict[str, Any] = {"achieved_l": achieved}
    if rate is not None:
        landed["correction_ms"] = [None if at is None else float(1000 * (at + wait) / rate) for at in achieved]
    return landed | {
        "misses": schedule.misses,
        "utilization": float(schedule.utilization),
        "preemptions": schedule.preemptions,
        "response": responses(schedule, rate),
    }


def responses(schedule: Schedule, rate: Fraction | None) -> dict[str, dict[str, Any]]:
    """By job kind, response times and lateness in HR periods, and in ms where a rate is given; None if no job of the
    kind has finished."""
    return {kind: _of_kind(figures, schedule.period, rate) for kind, figures in schedule.responses.items()}


def _of_kind(figures: Response, period: int, rate: Fraction | None) -> dict[str, Any]:
    finished = figures.finished
    times = {
        "max": Fraction(figures.worst, period) if finished else None,
        "mean": Fraction(figures.mean) / period if finished else None,
        "worst_lateness": Fraction(figures.worst_lateness, period),
    }
    return {
        **_in_unit(times, "periods", Fraction(1)),
        **({} if rate is None else _in_unit(times, "ms", 1000 / rate)),
        "releases": figures.releases,
        "misses": figures.misses,
        "preemptions": figures.preemptions,
    }


def _in_unit(times: dict[str, Fraction | None], unit: str, scale: Fraction) -> dict[str, float | None]:
    return {f"{name}_{unit}": None if time is None else float(time * scale) for name, time in times.items()}


def show(
    title: str,
    schedule: Schedule,
    achieved: Achieved,
    rate: Fraction | None,
    wait: Fraction,
    multirate: bool,
    more: str,
) -> None:
    """wait: steps from when a measurement is taken to k, at the most; more: another line below the table."""
    unit, key = ("HR periods", "periods") if rate is None else ("ms", "ms")
    figures_of = responses(schedule, rate)
    rows = [
        {
            "job": kind,
            "jobs": figures["releases"],
            "worst": _four_digits(figures[f"max_{key}"]),
            "mean": _four_digits(figures[f"mean_{key}"]),
            "missed": figures["misses"],
            "late by": _four_digits(figures[f"worst_lateness_{key}"]),
            "preempted": figures["preemptions"],
        }
        for kind, figures in figures_of.items()
    ]
    what = "Gains are in use from" if multirate else "Corrections land at"
    note = f"{landings(achieved, rate, wait, what)}; processor busy {percent(float(schedule.utilization))} of the time"
    unfinished = (
        "Jobs that have not finished are not in worst and mean; past their deadline they are missed, late by that much "
        "or more"
    )
    some = any(figures["max_periods"] is None or figures["misses"] for figures in figures_of.values())
    print_table(f"{title}; response times in {unit}", rows, lines(note, unfinished if some else "", more))


def _four_digits(time: float | None) -> str:
    return "-" if time is None else f"{time:.4g}"


def landings(achieved: Achieved, rate: Fraction | None, wait: Fraction, what: str) -> str:
    """Where the corrections of all cycles landed, or from where their gains are in use, in words; with a rate (Hz) in
    ms too, from when the measurement is taken."""
    landed = [at for at in achieved if at is not None]
    lost = len(achieved) - len(landed)
    if not landed:
        return f"{what} no step of the simulated time"
    first, last = min(landed), max(landed)
    where = f"l = k + {first}" if first == last else f"l = k + {first} to k + {last}"
    if rate is not None:
        least, most = (f"{float(1000 * at / rate):.6g}" for at in (first, last))
        where += f", {least if least == most else f'{least} to {most}'} ms after k"
        if wait:
            where += f", at most {no_less(1000 * (last + wait) / rate, 6)} ms after the measurement was taken"
    return f"{what} {where}" + (f", {lost} of {len(achieved)} not within the simulated time" if lost else "")
