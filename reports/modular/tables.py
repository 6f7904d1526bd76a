"""The tables of the report on modular filters; the first row of each is its heading."""

from __future__ import annotations

from reports.charts.panels import METHOD_NAMES
from reports.modular.costs import OPERATIONS
from reports.modular.oscillator import OSCILLATOR_AMPLITUDES, QUANTITIES, SENSORS, UNITS, Record
from reports.modular.results import OWN_MODEL, Results
from reports.modular.rocket import QUANTITIES as OF_ROCKET
from reports.modular.rocket_rows import CASES
from reports.modular.schedule import miss_rows_of, verdict_rows
from reports.modular.styles import WAY_NAMES
from reports.pages.machine import marked
from reports.pages.measurements import Shown, measurement_rows
from reports.pages.numbers import between, plus_minus, significant, span
from reports.pages.stored import Rows, digits
from sched_sim.scenario.distribution import wilson
from studies.machines.parts import PartTimes
from studies.modular import costs as modular_costs
from studies.modular import late_measurements, rocket
from studies.modular import oscillator as spring_mass
from studies.modular.rocket_readings import READINGS
from studies.modular.rocket_schedule import compared_at

COMPARED = ("0.1", "0.8")
"""The dropouts that the claim is about."""
MOST_PERCENT = 1000
"""That is told of a worst residual."""
LOST = ("0.5", "0.8", "0.9", "0.95", "0.98", "0.99")


def percent_of_amplitude(row: Record, name: str, kind: str = "") -> str:
    """RMS error of a typical run, or of an "unlucky" one, with its interval."""
    unit = 0.01 * OSCILLATOR_AMPLITUDES[name]
    return in_percents(*(value / unit for value in interval_of(row, "error", name, kind)))


def in_percents(value: float, low: float, high: float) -> str:
    """With its interval; in two digits from 100 % on, where a filter is lost."""
    digits = 3 if value < 100 else 2
    shown, *ends = (significant(number, digits) for number in (value, low, high))
    return f"{shown} ({' to '.join(ends)})"


def over(row: Record, what: str, name: str) -> str:
    """How many times as much as in the same run at 10 % dropout: typically, with its interval."""
    return between(*interval_of(row, what, name, "times"))


def interval_of(row: Record, what: str, name: str, kind: str = "") -> tuple[float, float, float]:
    """Value, low and high of the stored row."""
    ends = (" ".join(word for word in (what, kind, end, UNITS[name]) if word) for end in ("", "low", "high"))
    value, low, high = (float(row[end]) for end in ends)
    return value, low, high


def dropout_rows(results: Results) -> Rows:
    """Errors against dropout and the measurements in a period that get through, and NEES."""
    rows: Rows = [["Dropout, %", "get through", *QUANTITIES, "NEES"]]
    for row in results.records("dropout", group="usual"):
        errors = [percent_of_amplitude(row, name) for name in QUANTITIES]
        through = f"{spring_mass.USUAL.rate * (1 - float(row['dropout'])):.3g}"
        rows.append([_percent(row["dropout"]), through, *errors, nees_of(row)])
    return rows


def nees_of(row: Record) -> str:
    return plus_minus(float(row["nees"]), float(row["nees se"]))


def claim_rows(results: Results) -> Rows:
    """At 80 % over 10 %, by reading of "residual"."""
    (high,) = results.records("dropout", group="usual", dropout=COMPARED[1])
    rows: Rows = [["Reading, 80 % over 10 %", *QUANTITIES]]
    for what, said in (
        ("error", "error of the estimate"),
        ("innovation", "innovation"),
        ("after", "what is left after the update"),
    ):
        rows.append([said, *(over(high, what, n) if what == "error" or n in SENSORS else "-" for n in QUANTITIES)])
    return rows


def rate_rows(results: Results) -> Rows:
    """What sampling faster does to the claim; the last column follows from `spring_mass.BORNE`."""
    heads = ("error at 10 %", "error at 80 %", "times", "1 run in 20 above", "borne, %")
    rows: Rows = [["In a period", "runs", *heads]]
    for rate in sorted({*spring_mass.RATES, spring_mass.USUAL.rate}):
        low, high = (results.records("dropout", group=group_of(rate), dropout=dropout)[0] for dropout in COMPARED)
        errors = [percent_of_amplitude(row, "position") for row in (low, high)]
        others = [over(high, "error", "position"), percent_of_amplitude(high, "position", "unlucky")]
        rows.append([rate, high["runs"], *errors, *others, f"{100 * spring_mass.borne(rate):.0f}"])
    return rows


def group_of(rate: int) -> str:
    """The group of this sampling rate's stored rows."""
    return "usual" if rate == spring_mass.USUAL.rate else f"rate {rate}"


def sensor_rows(results: Results) -> Rows:
    """Which sensor loses measurements: RMS error of position."""
    rows: Rows = [["Dropout, %", "both sensors", "position only", "acceleration only"]]
    for dropout in LOST:
        groups = ("usual", *(f"{name} only" for name in SENSORS))
        records = [results.records("dropout", group=group, dropout=dropout)[0] for group in groups]
        rows.append([_percent(dropout), *(percent_of_amplitude(row, "position") for row in records)])
    return rows


SHORTER = {OWN_MODEL: "model true", "less process noise": "less noise"}
"""Names of the filters where a column is narrow."""


def consistency_rows(results: Results) -> Rows:
    """NEES of the three filters."""
    rows: Rows = [["Filter", "dropout, %", "NEES", "95 % bounds", "inside, %", "below, %", "above, %"]]
    for group in ("usual", "less process noise", OWN_MODEL):
        for dropout in ("0.1", "0.5", "0.8", "0.95"):
            (row,) = results.records("dropout", group=group, dropout=dropout)
            shares = [f"{100 * float(row[share]):.0f}" for share in ("inside", "below", "above")]
            limits = f"{row['low']} to {row['high']}"
            rows.append([SHORTER.get(group, group), _percent(dropout), nees_of(row), limits, *shares])
    return rows


# --------------------------------------------------------------------------------------------------------- the rocket


def rocket_error_rows(results: Results) -> Rows:
    """RMS errors of every case in a typical flight, and the largest of all flights."""
    rows: Rows = [["Filter", "flights", *OF_ROCKET, "position, largest"]]
    for row in results.records("rocket-errors"):
        errors = [rocket_error(row, name) for name in OF_ROCKET]
        largest = significant(float(row["position largest"]))
        rows.append([row["case"].replace(" x ", " × "), row["runs"], *errors, largest])
    return rows


def rocket_error(row: Record, name: str) -> str:
    """A typical flight's, with its interval."""
    return between(*(float(row[f"{name}{end}"]) for end in ("", " low", " high")))


def reading_rows(results: Results) -> Rows:
    """Each reading of the claim, without dropout."""
    heads = ("all, from s", "half, from s", "hold, %", "typical mean, %", "worst, %")
    rows: Rows = [["Residual", *heads]]
    for row in results.records("rocket-residuals", case=rocket.BASE.name):
        from_s = [_never(row[name]) for name in ("holds from s", "half from s")]
        typical = between(*(float(row[name]) for name in ("typical", "low", "high")))
        rows.append([row["reading"], *from_s, share_that_holds(row), typical, _worst(float(row["worst"]))])
    return rows


def lost_rows(results: Results) -> Rows:
    """Which share of the flights keeps to the claim from 1 s on, by dropout."""
    rows: Rows = [["Residual", *(f"dropout {dropout}" for dropout in CASES)]]
    for reading in READINGS:
        records = [results.records("rocket-residuals", case=case, reading=reading)[0] for case in CASES.values()]
        rows.append([reading, *map(share_that_holds, records)])
    return rows


def share_that_holds(row: Record) -> str:
    """The share of the flights in percent, with its 95 % interval."""
    return share_of(int(row["hold"]), int(row["runs"]))


def share_of(hold: int, runs: int) -> str:
    """In percent, with its 95 % interval."""
    share, *ends = (f"{100 * value:.0f}" for value in (hold / runs, *wilson(hold, runs)))
    return f"{share} ({' to '.join(ends)})"


def rocket_nees_rows(results: Results) -> Rows:
    """NEES of all errors, by phase and dropout."""
    rows: Rows = [["Phase", *(f"dropout {dropout}" for dropout in CASES), "95 % bounds"]]
    for phase in rocket.PHASES:
        records = [results.records("rocket-nees", case=case, phase=phase, of="all")[0] for case in CASES.values()]
        means = [plus_minus(float(row["mean"]), float(row["se"])) for row in records]
        rows.append([phase, *means, f"{records[0]['low']} to {records[0]['high']}"])
    return rows


# -------------------------------------------------------------------------------------------------- late measurements

COSTED = 8
"""The delay that the costs in the table are of: the longest that all ways can do with."""


def late_rows(results: Results) -> Rows:
    """Errors by delay, and costs."""
    heads = [f"{delay} late" for delay in late_measurements.DELAYS]
    rows: Rows = [["Sensors", "Way", *heads, "work", "longest"]]
    for sensors in late_measurements.SENSORS:
        for way in late_measurements.WAYS:
            of_way = {row["delay"]: row for row in results.records("late", sensors=sensors, way=way)}
            if of_way:
                asked = [of_way.get(str(delay)) for delay in late_measurements.DELAYS]
                errors = ["-" if row is None else late_error(row) for row in asked]
                work = [f"{float(of_way[str(COSTED)][name]):,.0f}" for name in ("mean", "longest")]
                rows.append(["both" if " and " in sensors else sensors, METHOD_NAMES[way], *errors, *work])
    return rows


def late_error(row: Record) -> str:
    """RMS error of position in percent of the amplitude, which is 1 m."""
    return plus_minus(100 * float(row["error"]), 100 * float(row["se"]))


# -------------------------------------------------------------------------------------------------------------- costs


COUNTED = [f"n = {states}" for states in modular_costs.STATES]
TIMED = [marked(f"n = {states}, µs") for states in modular_costs.STATES]
"""Headings of `part_rows`."""


def part_rows(results: Results) -> Rows:
    """Operations, and the range of the least times over all measurements, by kind, part and states."""
    rows: Rows = [["Filter", "Part", *(head for of_size in zip(COUNTED, TIMED, strict=True) for head in of_size)]]
    for part in modular_costs.PARTS:
        for kind in modular_costs.KINDS:
            records = [results.records("parts", kind=kind, part=part, states=str(n))[0] for n in modular_costs.STATES]
            numbers = [
                cell
                for row, n in zip(records, modular_costs.STATES, strict=True)
                for cell in (f"{int(row[OPERATIONS]):,}", span(*map(digits, results.least(kind, n, part))))
            ]
            rows.append([kind, part, *numbers])
    return rows


def measurement_rows_of(results: Results) -> Rows:
    """The largest and the smallest of the unscented parts by each measurement, in µs, from least to median."""

    def of(states: int, part: modular_costs.Part) -> Shown[PartTimes]:
        return lambda times: span(*map(digits, times.parts["unscented", str(states), part]))

    sizes = (modular_costs.STATES[0], modular_costs.STATES[-1])
    figures = {f"{part}, n = {n}, µs": of(n, part) for part in modular_costs.PARTS for n in sizes}
    return measurement_rows(results.measurements, figures)


# ------------------------------------------------------------------------------------------------------- the schedule


def verdict_on_processors(results: Results) -> Rows:
    """Down to which clock each way holds, and what is late on one of the processors."""
    misses = miss_rows_of(results.records("schedule-misses"))
    heads = ("from, MHz", "busy, %", "loop, %", "by, ms", "control, %", "GPS, %")
    return [["Late fix", "correction", *heads], *verdict_rows(misses, compared_at(misses))[1:]]


def spent_on(results: Results) -> Rows:
    """What the time of that processor goes into, in percent."""
    heads = {
        "predict": "prediction (%)",
        "on time": "on-time corrections (%)",
        "replay": "replay (%)",
        "catch up": "catching up (%)",
        "idle": "idle (%)",
        "GPS, ms": "GPS response, median (ms)",
    }
    kept = ("late GPS fix", "its correction", *heads.values())
    records = results.records("schedule-shares")
    return [
        ["Late fix", "correction", *heads],
        *([WAY_NAMES[row[kept[0]]], *(row[name] for name in kept[1:])] for row in records),
    ]


def without(rows: Rows, *heads: str) -> Rows:
    """A table less some of its columns."""
    kept = [at for at, head in enumerate(rows[0]) if head not in heads]
    return [[row[at] for at in kept] for row in rows]


def _worst(percent: float) -> str:
    """Beyond a limit how far is only how near zero that is which it is compared with."""
    return f"over {MOST_PERCENT:,}" if percent > MOST_PERCENT else significant(percent, 2)


def _never(seconds: str) -> str:
    return "never" if seconds == "inf" else f"{float(seconds):.2f}"


def _percent(share: str) -> str:
    return f"{100 * float(share):g}"
