"""Methods that wait for one measurement at a time, where others are taken before it arrives."""

from __future__ import annotations

from fractions import Fraction
from itertools import count
from math import ceil

from filters.accuracy.pattern import MOST_MEASUREMENTS
from filters.accuracy.predictor import MOST_INNOVATIONS
from sched_sim.design.methods import METHODS as SCHEDULED
from sched_sim.design.options import Options
from sched_sim.errors import option
from studies.selection.methods import METHODS
from studies.selection.sampling import Sampling


def too_late(method: str, sampling: Sampling, every: int, options: Options) -> str:
    """Why the method cannot have such a delay with every so manieth measurement, and what would do; empty if it can."""
    using = sampling.using(every)
    N, M = using.N, using.M
    law = None if method not in SCHEDULED else SCHEDULED[method].law(options.feedback)
    if law is None or law.undelayed or law.why_none(N, M) is None:
        return ""
    left = law.after + law.before
    enough = next(
        number for number in count(max((M + left) // (sampling.N + 1), 1)) if M + left <= sampling.using(number).N
    )
    others = [name for name in METHODS if _can_have(name, N, M, options)]
    delay, interval = _delay(using), _interval(using)
    why = (
        f"one measurement is on its way at a time, and with {delay} others are taken before it arrives, {interval}"
        if M > N
        else f"no step is left between a measurement's arrival and the next one with {delay}, {interval}"
    )
    return f"{why}: choose {option('method')} {', '.join(others[:-1])} or {others[-1]}, or {option('every')} {enough}"


def too_irregular(method: str, using: Sampling, options: Options) -> str:
    """Why the method has no figures where the intervals between measurements repeat too late, and what would do; empty
    if it has."""
    most = _most_measurements(method, options)
    between = Fraction(using.between)
    if most is None or between.denominator <= most or using.hr_hz is None:
        return ""
    hz = using.hr_hz / between
    nearest = next(count * hz for count in (round(between), ceil(between)) if count >= 1)
    return (
        f"at {option('hr_hz')} {float(using.hr_hz):g} and with a measurement every {float(1000 / hz):g} ms the "
        f"intervals between them repeat after {between.denominator:,}, and of this method at most {most:,} are looked "
        f"at one by one: give {option('hr_hz')} {float(nearest):.12g}, which the measurements divide, or choose "
        f"{option('method')} clone"
    )


def _most_measurements(method: str, options: Options) -> int | None:
    """Of a repetition, that are looked at one by one; None where a bound is known beyond."""
    if method == "px4-predictor":
        return MOST_INNOVATIONS
    rough = method == "dual-rate" and options.low_rate_noise != "exact"
    return MOST_MEASUREMENTS if rough or method == "fuse-as-fresh" else None


def _can_have(method: str, N: int, M: int, options: Options) -> bool:
    if method not in SCHEDULED or METHODS[method].landing == "at once" or not METHODS[method].lossless:
        return False
    law = SCHEDULED[method].law(options.feedback)
    return not law.undelayed and law.why_none(N, M) is None


def _delay(sampling: Sampling) -> str:
    """In ms where the rate is known, and in steps."""
    steps = f"{option('M')} {sampling.M}"
    if sampling.times is None or sampling.times.delay_ms is None:
        return steps
    return f"{option('delay_ms')} {float(sampling.times.delay_ms):g} ({steps})"


def _interval(sampling: Sampling) -> str:
    steps = f"{option('N')} {sampling.N}"
    if sampling.times is None or sampling.times.measurement_hz is None:
        return f"every {sampling.N} steps ({steps})"
    return f"every {float(1000 / sampling.times.measurement_hz):g} ms ({steps})"
