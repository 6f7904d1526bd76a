"""What is said of times that no method, or not this one, can keep at a rate: in the words and units in which they were
given, with the limit."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import ceil, floor

from sched_sim.design.times import Steps, Times
from sched_sim.errors import InputError, option

SO_MANY_TIMES = 4
"""The rates that are looked at are up to so many times the one that was given."""


def check_times(times: Times, steps: Steps, hr_hz: Fraction, after: int = 0, before: int | None = 0) -> None:
    """Raises InputError for a delay or a landing out of bounds that was given as a time, or beside a rate of
    measurements. What was given in steps alone is for `Timing` to check.

    times: as they were given; steps: what all came to. A correction lands from M + after to N - before, or, where
    before is None, from M + after on: then several measurements may be on their way.
    """
    N, M, L = steps
    assert N is not None
    assert M is not None
    first, last = M + after, None if before is None else N - before
    said = times.delay_ms is not None or times.measurement_hz is not None
    if before is not None and first > N - before and said:
        raise InputError(_too_late_to_wait(times, N, M, hr_hz, after + before))
    if L is None or times.land_within_ms is None:
        return
    land, at = f"{option('land_within_ms')} {_shown(times.land_within_ms)}", f"{_hr(hr_hz)} and {_measured(times, N)}"
    if last is not None and last < L:
        most = _shown(times.landing_ms(last, hr_hz), floor)
        raise InputError(
            f"{land} is later than the correction may land: before the next measurement is taken, at {at} within "
            f"{most} ms; give {most} or less, or leave it out for the latest"
        )
    if first > L:
        least = _shown(times.landing_ms(first, hr_hz), ceil)
        raise InputError(
            f"{land} is before the correction can land: at {at} that is {least} ms after the measurement is taken; "
            f"give {least} or more"
        )


def _too_late_to_wait(times: Times, N: int, M: int, hr_hz: Fraction, left: int) -> str:
    """left: steps that the method needs beside M of the N."""
    hz = times.measurement_hz or hr_hz / N
    measured, every = _measured(times, N), f"every = {N}" if times.measurement_hz is None else f"hz = {_exact(hz)}"
    if times.delay_ms is None:
        delay_ms, late = M * 1000 / hr_hz, f"delay = {M}"
        delay = f"{option('M')} {M} ({_shown(delay_ms)} ms)"
    else:
        delay_ms, late = times.delay_ms, f"delay_ms = {_exact(times.delay_ms)}"
        delay = f"{option('delay_ms')} {_shown(delay_ms)}"
    one = "this method waits for one measurement at a time"
    other = (
        f"choose {option('method')} recalculate, larsen, clone, carried-gain or dual-rate, or simulate several on "
        f"their way with `sched-sim simulate --scenario FILE.toml`, and write in it under [[sensor]] `{every}` and "
        f"`{late}`"
    )
    if M <= N:
        one = "this method needs a step from a measurement's arrival to the next one"
        other = (
            f"choose {option('method')} recalculate or larsen, which correct the state in that very step, or dual-rate"
        )
    most = f"the delay is at most {_shown((N - left) * 1000 / hr_hz, floor)} ms"
    if delay_ms > 1000 / hz:
        between = f"the {_shown(1000 / hz)} ms from one measurement to the next ({measured})"
        return f"{delay} is longer than {between}, and {one}: at {_hr(hr_hz)} {most}; {other}"
    steps = (
        f"M = {M} steps{'' if delay_ms * hr_hz == 1000 * M else ', rounded up,'} of "
        f"N = {N}{'' if hr_hz == N * hz else ', rounded down'}"
    )
    rates = " or ".join(map(_shown, _rates(hr_hz, hz, delay_ms, left)))
    if rates:
        other = f"choose {option('hr_hz')} {rates}, at which {_shown(delay_ms)} ms can be, or {other}"
    return f"{delay} and {measured} are at {_hr(hr_hz)} {steps}, and {one}: {most} there; {other}"


def _rates(hr_hz: Fraction, hz: Fraction, delay_ms: Fraction, left: int) -> list[Fraction]:
    """Rates of the HR loop near this one at which the delay can be, below it and above: those that the rate of
    measurements divides are the best for it, here with two decimals."""

    def can_be(rate: Fraction) -> bool:
        return ceil(delay_ms * rate / 1000) + left <= floor(rate / hz)

    near = int(hr_hz / hz)
    below = (Fraction(ceil(100 * hz * count), 100) for count in range(near, 0, -1))
    above = (Fraction(ceil(100 * hz * count), 100) for count in range(near + 1, SO_MANY_TIMES * (near + 1) + 1))
    found = [next((rate for rate in rates if can_be(rate)), None) for rates in (below, above)]
    return [rate for rate in found if rate is not None]


def _hr(hr_hz: Fraction) -> str:
    return f"{option('hr_hz')} {_shown(hr_hz)}"


def _measured(times: Times, N: int) -> str:
    if times.measurement_hz is None:
        return f"{option('N')} {N}"
    return f"{option('measurement_hz')} {_shown(times.measurement_hz)}"


def _shown(value: Fraction, rounded: Callable[[Fraction], int] | None = None) -> str:
    """As it was written where it is a short decimal; limits to three decimals, rounded to the side on which they
    hold."""
    if rounded is not None:
        return f"{rounded(1000 * value) / 1000:.12g}"
    return f"{float(value):.6g}" if _exact(value).startswith('"') else _exact(value)


def _exact(value: Fraction) -> str:
    """As a TOML file has it: a short decimal, or a quotient in quotes."""
    decimal = f"{float(value):.12g}"
    return decimal if Fraction(decimal) == value else f'"{value}"'
