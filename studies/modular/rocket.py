"""Can a filter that knows neither mass nor thrust follow a rocket? Simulated flights, from the pad to apogee.

The claim of MacCormack and Rubinstein, Implementation of a modular linear and unscented Kalman filter: "residuals for
position and orientation of the rocket were found to be within acceptable ranges (<15%) during ascent". They do not say
of what 15 % is. So the study tries the readings that suggest themselves (`rocket_readings`), and gives for each the
time after ignition from which it holds.

Figures are in the report `modular`; this is what they say.

Position: as a share of the distance from the pad it holds in all flights from half a second after ignition on. It also
holds a second after ignition if 80 % of all measurements are lost, or all of any one sensor: even the accelerometer,
without which the filter lags behind the thrust. At 95 % it fails in every fifth flight. As a share of the horizontal
distance it holds in all flights only from about two seconds on. Each axis for itself it does not: coordinates pass
through zero.

Orientation: as a share of all that was turned it holds from about a second on, for before that little turns. As a share
of the net turn it fails where roll has come round to where it began, and of the nose's turn where that is small,
although the errors stay below a degree. As difference of quaternions, where 15 % are 17 degrees, it says little: it
holds at once. By the readings that are shares of a turn, a third of the flights or more fail at 80 % dropout, and
nearly all at 95 %.

The filter is as accurate as it says, but for the onset of thrust, and for lost measurements: noise that has the mean
square of the flight's jerk is not that of its onset. An extended predictor does as well as the unscented one, to the
digits that are shown: 10 ms of flight are as good as linear. Sensors have white noise only, of known size; biases are
tried in `biases`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from filters.arrays import FloatArray
from filters.systems.rocket import BURN_S
from filters.systems.rocket_filter import OF, SENSORS, TUNED, ProcessNoise
from studies.modular.nees import Bounds, bounds, nees
from studies.modular.rocket_flights import Case, Run, flight, follow, measure
from studies.modular.rocket_readings import READINGS, length
from studies.modular.typical import Quantile, quantile

Progress: TypeAlias = Callable[[int, int, str], None]

NAME = "rocket"
QUESTION = (
    "Do position and orientation of a rocket stay within 15 % during ascent, if neither mass nor thrust is known?"
)
SEEDS, FEW_SEEDS = tuple(range(60)), tuple(range(20))
CLAIM_PERCENT = 15.0
SETTLED_S = 1.0
"""Residuals are summed up from this time after ignition on: at liftoff they are shares of zero."""


BASE = Case("unscented")
EXTENDED = Case("extended", "extended")
EXTENDED_DROPOUT = Case("extended, dropout 95 %", "extended", dropout=0.95)
DROPOUT_CASES = (BASE, *(Case(f"dropout {100 * share:.0f} %", dropout=share) for share in (0.5, 0.8, 0.95)))
BLIND_CASES = tuple(Case(f"no {sensor}", without=sensor) for sensor in SENSORS)
NOISE_CASES = tuple(
    Case(f"process noise x {ratio:g}", noise=ProcessNoise(*(ratio * density for density in TUNED)))
    for ratio in (0.1, 10.0)
)
MAIN_CASES, SIDE_CASES = (*DROPOUT_CASES, EXTENDED, EXTENDED_DROPOUT), (*BLIND_CASES, *NOISE_CASES)
"""The main ones fly with all seeds, the others with few."""

QUANTITIES = ("position, m", "velocity, m/s", "acceleration, m/s^2", "turn rate, deg/s", "orientation, deg")
UNITS = np.array([1.0, 1.0, 1.0, np.degrees(1.0), np.degrees(1.0)])
PHASES = {
    "on the pad": (-0.5, 0.0),
    "thrust onset": (0.0, 0.3),
    "powered": (0.3, BURN_S - 0.3),
    "burnout": (BURN_S - 0.3, BURN_S + 0.3),
    "coast": (BURN_S + 0.3, np.inf),
}
"""Seconds since ignition; the last ends at apogee."""


class Summary(NamedTuple):
    """What is kept of a run.

    residuals (readings, steps + 1), percent. nees (1 + quantities, steps + 1): of all 15 errors, and of each quantity's
    3. rms, largest (quantities,): of the errors' lengths, from ignition to apogee, in the units of `QUANTITIES`.
    """

    time_s: FloatArray
    residuals: FloatArray
    nees: FloatArray
    rms: FloatArray
    largest: FloatArray


class ErrorRow(NamedTuple):
    """rms (runs, quantities): of each run, from ignition to apogee. largest (quantities,): of all runs."""

    case: Case
    rms: FloatArray
    largest: FloatArray


class ResidualRow(NamedTuple):
    """How one reading of the claim fares in one case.

    typical: of a run's mean from 1 s after ignition to apogee; worst: of all runs and times there; both in percent.
    hold: how many of the runs stay below 15 % from 1 s on. holds_from_s: since ignition, the time from which all runs
    do, inf if there is none; half_from_s: half of them.
    """

    case: Case
    reading: str
    typical: Quantile
    worst: float
    hold: int
    runs: int
    holds_from_s: float
    half_from_s: float


class NeesRow(NamedTuple):
    """mean, standard_error: over runs, of the mean over a phase; n if consistent, the number of errors in `of`.

    bounds: 95 % of the mean over runs in one step; below, above: the percentage of steps in which it is there.
    """

    case: Case
    phase: str
    of: str
    n: int
    mean: float
    standard_error: float
    bounds: Bounds
    below: float
    above: float


class Series(NamedTuple):
    """One case over time: as long as the shortest of its flights.

    time_s (times,). median, high (readings, times): residuals in percent, half and 95 % of the runs are below.
    nees (1 + quantities, times): mean over the runs; bounds of the first, bounds_of_three of the others.
    """

    case: Case
    time_s: FloatArray
    median: FloatArray
    high: FloatArray
    nees: FloatArray
    bounds: Bounds
    bounds_of_three: Bounds


class RocketResults(NamedTuple):
    """Rows of all cases; series of the main ones. apogee_m (runs,): height."""

    apogee_m: FloatArray
    errors: tuple[ErrorRow, ...]
    residuals: tuple[ResidualRow, ...]
    nees: tuple[NeesRow, ...]
    series: tuple[Series, ...]


def summary(run: Run) -> Summary:
    """A run in short."""
    ascent = run.time_s >= 0.0
    parts = [slice(None), *(slice(at, at + 3) for at in range(0, OF.errors, 3))]
    lengths = np.stack([length(run.errors[ascent, part]) for part in parts[1:]])
    return Summary(
        run.time_s,
        100.0 * np.stack([reading(run) for reading in READINGS.values()]),
        np.stack([nees(run.errors[:, part], run.P[:, part, part]) for part in parts]),
        UNITS * np.sqrt(np.mean(lengths**2, axis=1)),
        UNITS * lengths.max(axis=1),
    )


def holds_from(time_s: FloatArray, residual: FloatArray) -> float:
    """The first of these times, from ignition on, from which the residual stays below 15 %; inf if it ends above."""
    above = np.flatnonzero(~(residual < CLAIM_PERCENT) | (time_s < 0.0))
    following = above[-1] + 1
    return float(time_s[following]) if following < len(time_s) else float("inf")


def error_row(case: Case, runs: Sequence[Summary]) -> ErrorRow:
    """The row of all runs of a case."""
    largest = np.max([run.largest for run in runs], axis=0)
    return ErrorRow(case, np.stack([run.rms for run in runs]), largest)


def residual_rows(case: Case, runs: Sequence[Summary]) -> tuple[ResidualRow, ...]:
    """A case's rows over all its runs, one for each reading."""
    return tuple(
        residual_row(case, reading, [(run.time_s, run.residuals[number]) for run in runs])
        for number, reading in enumerate(READINGS)
    )


def residual_row(case: Case, reading: str, runs: Sequence[tuple[FloatArray, FloatArray]]) -> ResidualRow:
    """A case's row. runs: of each the times and this reading of its residual."""
    settled = [residual[time_s >= SETTLED_S] for time_s, residual in runs]
    worst = np.array([np.max(part) for part in settled])
    from_s = [holds_from(*run) for run in runs]
    return ResidualRow(
        case=case,
        reading=reading,
        typical=quantile(np.array([np.mean(part) for part in settled])),
        worst=float(worst.max()),
        hold=int(np.sum(worst < CLAIM_PERCENT)),
        runs=len(runs),
        holds_from_s=max(from_s),
        half_from_s=float(np.median(from_s)),
    )


def nees_rows(case: Case, runs: Sequence[Summary]) -> tuple[NeesRow, ...]:
    """A case's rows: each phase, all errors and each quantity's."""
    time_s, values = _together(runs)
    parts = [("all", OF.errors), *((quantity.split(",")[0], 3) for quantity in QUANTITIES)]
    return tuple(
        nees_row(case, phase, quantity, n, values[:, number, (time_s >= begin_s) & (time_s < end_s)])
        for phase, (begin_s, end_s) in PHASES.items()
        for number, (quantity, n) in enumerate(parts)
    )


def nees_row(case: Case, phase: str, quantity: str, n: int, values: FloatArray) -> NeesRow:
    """values (runs, steps): NEES in this phase, of errors of length n."""
    mean, standard_error = _mean(values.mean(axis=1))
    limits, steps = bounds(len(values), n), values.mean(axis=0)
    below, above = 100.0 * float(np.mean(steps < limits.low)), 100.0 * float(np.mean(steps > limits.high))
    return NeesRow(case, phase, quantity, n, float(mean), float(standard_error), limits, below, above)


def series(case: Case, runs: Sequence[Summary]) -> Series:
    """The series of all runs of a case."""
    time_s, values = _together(runs)
    residuals = np.stack([run.residuals[:, : len(time_s)] for run in runs])
    return Series(
        case, time_s, np.median(residuals, axis=0), np.percentile(residuals, 95, axis=0, method="lower"),
        values.mean(axis=0), bounds(len(runs), OF.errors), bounds(len(runs), 3),
    )  # fmt: skip


def rocket_study(
    seeds: Sequence[int] = SEEDS,
    few_seeds: Sequence[int] = FEW_SEEDS,
    *,
    main: Sequence[Case] = MAIN_CASES,
    side: Sequence[Case] = SIDE_CASES,
    progress: Progress = lambda _done, _total, _what: None,
) -> RocketResults:
    """The whole study, half a minute once compiled. progress(done, total, what) is told after each flight.

    All cases fly the same flights, with the same measurements as long as these are not lost.
    """
    kept: dict[str, list[Summary]] = {case.name: [] for case in (*main, *side)}
    apogees = []
    for done, seed in enumerate(seeds):
        flown = flight(seed)
        apogees.append(float(flown.states[-1, 2]))
        cases = (*main, *side) if seed in few_seeds else main
        measured = {share: measure(share, seed, flown.states) for share in {case.dropout for case in cases}}
        for case in cases:
            kept[case.name].append(summary(follow(case, seed, flown.states, flown.time_s, measured[case.dropout])))
        progress(done + 1, len(seeds), "flights")
    every = [(case, kept[case.name]) for case in (*main, *side) if kept[case.name]]
    return RocketResults(
        np.array(apogees),
        tuple(error_row(case, runs) for case, runs in every),
        tuple(row for case, runs in every for row in residual_rows(case, runs)),
        tuple(row for case, runs in every for row in nees_rows(case, runs)),
        tuple(series(case, kept[case.name]) for case in main),
    )


def _together(runs: Sequence[Summary]) -> tuple[FloatArray, FloatArray]:
    """Times of the shortest flight, and NEES (runs, 1 + quantities, times)."""
    time_s = min((run.time_s for run in runs), key=len)
    return time_s, np.stack([run.nees[:, : len(time_s)] for run in runs])


def _mean(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean over the first axis, and its standard error."""
    spread = values.std(axis=0, ddof=1) if len(values) > 1 else np.full(values.shape[1:], np.nan)
    return values.mean(axis=0), spread / np.sqrt(len(values))
