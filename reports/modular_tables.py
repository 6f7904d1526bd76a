"""The tables of the report on modular filters; the first row of each is its heading."""

from __future__ import annotations

from collections.abc import Sequence

from reports.modular_costs import OPERATIONS, SECONDS
from reports.modular_oscillator import OSCILLATOR_AMPLITUDES, QUANTITIES, SENSORS, UNITS, Record
from reports.modular_results import OWN_MODEL, Results
from reports.modular_rocket import QUANTITIES as OF_ROCKET
from reports.modular_rocket_rows import CASES
from reports.modular_schedule import miss_rows_of, verdict_rows
from reports.multirate_words import significant
from reports.stored import Rows
from studies import late_measurements, modular_costs, rocket, spring_mass
from studies.rocket_readings import READINGS
from studies.rocket_schedule import compared_at

COMPARED = ("0.1", "0.8")
"""The dropouts that the claim is about."""
LOST = ("0.5", "0.8", "0.9", "0.95", "0.98", "0.99")


def percent_of_amplitude(row: Record, name: str, *, se: bool = False) -> str:
    """RMS error, or its standard error twice."""
    value = 100 * float(row[f"error {'se ' if se else ''}{UNITS[name]}"]) / OSCILLATOR_AMPLITUDES[name]
    return significant(2 * value, 2) if se else significant(value)


def over(row: Record, base: Record, column: str) -> str:
    """How many times as much."""
    return significant(float(row[column]) / float(base[column]))


def dropout_rows(found: Results) -> Rows:
    """Errors against dropout, and NEES."""
    rows: Rows = [["Dropout, %", "gap, periods", *QUANTITIES, "NEES", "inside, %"]]
    for row in found.records("dropout", group="usual"):
        errors = [f"{percent_of_amplitude(row, n)} ± {percent_of_amplitude(row, n, se=True)}" for n in QUANTITIES]
        share = f"{100 * float(row['inside']):.0f}"
        rows.append([_percent(row["dropout"]), row["interval"], *errors, row["nees"], share])
    return rows


def claim_rows(found: Results) -> Rows:
    """At 80 % over 10 %, by reading of "residual"."""
    low, high = (found.records("dropout", group="usual", dropout=dropout)[0] for dropout in COMPARED)
    rows: Rows = [["Reading, 80 % over 10 %", *QUANTITIES]]
    for what, said in (
        ("error", "error of the estimate"),
        ("innovation", "innovation"),
        ("after", "what is left after the update"),
    ):
        ratios = [over(high, low, f"{what} {UNITS[n]}") if what == "error" or n in SENSORS else "-" for n in QUANTITIES]
        rows.append([said, *ratios])
    return rows


def rate_rows(found: Results) -> Rows:
    """What sampling faster does to the claim; the last column follows from `spring_mass.BORNE`."""
    rows: Rows = [["In a period", "error at 10 %", "error at 80 %", "times", "borne, %"]]
    for rate in sorted({*spring_mass.RATES, spring_mass.USUAL.rate}):
        low, high = (found.records("dropout", group=group_of(rate), dropout=dropout)[0] for dropout in COMPARED)
        errors = [percent_of_amplitude(row, "position") for row in (low, high)]
        rows.append([rate, *errors, over(high, low, "error m"), f"{100 * spring_mass.borne(rate):.1f}"])
    return rows


def group_of(rate: int) -> str:
    """Of the stored rows of this sampling rate."""
    return "usual" if rate == spring_mass.USUAL.rate else f"rate {rate}"


def sensor_rows(found: Results) -> Rows:
    """Which sensor loses measurements: RMS error of position."""
    rows: Rows = [["Dropout, %", "both sensors", "position only", "acceleration only"]]
    for dropout in LOST:
        groups = ("usual", *(f"{name} only" for name in SENSORS))
        of = [found.records("dropout", group=group, dropout=dropout)[0] for group in groups]
        rows.append([_percent(dropout), *(percent_of_amplitude(row, "position") for row in of)])
    return rows


def consistency_rows(found: Results) -> Rows:
    """NEES of the three filters."""
    rows: Rows = [["Filter", "dropout, %", "runs", "NEES", "95 % bounds", "inside, %", "below, %", "above, %"]]
    for group in ("usual", "less process noise", OWN_MODEL):
        for dropout in ("0.1", "0.5", "0.8", "0.95"):
            (row,) = found.records("dropout", group=group, dropout=dropout)
            shares = [f"{100 * float(row[share]):.0f}" for share in ("inside", "below", "above")]
            limits = f"{row['low']} to {row['high']}"
            rows.append([group, _percent(dropout), row["runs"], row["nees"], limits, *shares])
    return rows


# --------------------------------------------------------------------------------------------------------- the rocket


def rocket_error_rows(found: Results) -> Rows:
    """RMS errors of every case, means over the flights."""
    rows: Rows = [["Filter", "flights", *OF_ROCKET, "position, max"]]
    for row in found.records("rocket-errors"):
        rows.append(
            [row["case"], row["runs"], *(row[name] for name in OF_ROCKET), significant(float(row["position largest"]))]
        )
    return rows


def reading_rows(found: Results) -> Rows:
    """Each reading of the claim, without dropout."""
    heads = ("all, from s", "half, from s", "hold, %", "mean, %", "worst, %")
    rows: Rows = [["Residual", *heads]]
    for row in found.records("rocket-residuals", case=rocket.BASE.name):
        from_s = [_never(row[name]) for name in ("holds from s", "half from s")]
        rows.append([row["reading"], *from_s, _whole(row["runs hold"]), row["mean"], significant(float(row["worst"]))])
    return rows


def lost_rows(found: Results) -> Rows:
    """Which share of the flights keeps to the claim from 1 s on, by dropout."""
    rows: Rows = [["Residual", *(f"dropout {dropout}" for dropout in CASES)]]
    for reading in READINGS:
        of = [found.records("rocket-residuals", case=case, reading=reading)[0] for case in CASES.values()]
        rows.append([reading, *(_whole(row["runs hold"]) for row in of)])
    return rows


def rocket_nees_rows(found: Results) -> Rows:
    """NEES of all errors, by phase and dropout."""
    rows: Rows = [["Phase", *(f"dropout {dropout}" for dropout in CASES), "95 % bounds"]]
    for phase in rocket.PHASES:
        of = [found.records("rocket-nees", case=case, phase=phase, of="all")[0] for case in CASES.values()]
        means = [f"{significant(float(row['mean']))} ± {significant(2 * float(row['se']), 2)}" for row in of]
        rows.append([phase, *means, f"{of[0]['low']} to {of[0]['high']}"])
    return rows


# -------------------------------------------------------------------------------------------------- late measurements

COSTED = 8
"""The delay that the costs in the table are of: the longest that all ways can do with."""


def late_rows(found: Results) -> Rows:
    """Errors by delay, and costs."""
    heads = [f"{delay} late" for delay in late_measurements.DELAYS]
    rows: Rows = [["Sensors", "Way", *heads, "work", "longest"]]
    for sensors in late_measurements.SENSORS:
        for way in late_measurements.WAYS:
            of_way = {row["delay"]: row for row in found.records("late", sensors=sensors, way=way)}
            if of_way:
                asked = [of_way.get(str(delay)) for delay in late_measurements.DELAYS]
                errors = ["-" if row is None else significant(100 * float(row["error"])) for row in asked]
                work = [f"{float(of_way[str(COSTED)][name]):,.0f}" for name in ("mean", "longest")]
                rows.append([sensors.replace(" and ", ", "), way, *errors, *work])
    return rows


# -------------------------------------------------------------------------------------------------------------- costs


def part_rows(found: Results) -> Rows:
    """Operations and times by kind, part and states."""
    rows: Rows = [["Filter", "Part"]]
    for states in modular_costs.STATES:
        rows[0] = [*rows[0], f"n = {states}", f"{states}: µs †"]
    for part in modular_costs.PARTS:
        for kind in modular_costs.KINDS:
            of = [found.records("parts", kind=kind, part=part, states=str(n))[0] for n in modular_costs.STATES]
            numbers = [cell for row in of for cell in (f"{int(row[OPERATIONS]):,}", row[SECONDS])]
            rows.append([kind, part, *numbers])
    return rows


# ------------------------------------------------------------------------------------------------------- the schedule

MARK = "†"


def verdict_on_processors(found: Results) -> Rows:
    """How slow a processor may be, and what is late on one of them; all by times measured here."""
    misses = miss_rows_of(found.records("schedule-misses"))
    at = compared_at(misses)
    heads = ("holds to", f"busy at {at}, %", "loop, %", "by, ms", "control, %", "GPS, %")
    return _marked(("Late fix", "correction", *heads), verdict_rows(misses, at))


def spent_on(found: Results) -> Rows:
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
    records = found.records("schedule-shares")
    return _marked(("Late fix", "correction", *heads), [kept, *([row[name] for name in kept] for row in records)])


def _marked(heads: Sequence[str], rows: Rows) -> Rows:
    """The rows under these heads, of which all but the first two are marked as measured."""
    return [[*heads[:2], *(f"{head} {MARK}" for head in heads[2:])], *rows[1:]]


def _never(seconds: str) -> str:
    return "never" if seconds == "inf" else f"{float(seconds):.2f}"


def _whole(percent: str) -> str:
    return f"{float(percent):.0f}"


def _percent(share: str) -> str:
    return f"{100 * float(share):g}"
