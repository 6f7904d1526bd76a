"""The tables of the report on modular filters; the first row of each is its heading."""

from __future__ import annotations

from reports.modular_oscillator import OSCILLATOR_AMPLITUDES, QUANTITIES, SENSORS, UNITS, Record
from reports.modular_results import OWN_MODEL, Results
from reports.multirate_words import significant
from reports.stored import Rows
from studies import spring_mass

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
    heads = [f"{name}, % of amplitude" for name in QUANTITIES]
    rows: Rows = [["Dropout, %", "gap, periods", *heads, "NEES", "inside, %"]]
    for row in found.records("dropout", group="usual"):
        errors = [f"{percent_of_amplitude(row, n)} ± {percent_of_amplitude(row, n, se=True)}" for n in QUANTITIES]
        share = f"{100 * float(row['inside']):.0f}"
        rows.append([_percent(row["dropout"]), row["interval"], *errors, row["nees"], share])
    return rows


def verdict_rows(found: Results) -> Rows:
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
    rows: Rows = [["In a period", "10 %, % of amplitude", "80 %, % of amplitude", "times", "borne, %"]]
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


def _percent(share: str) -> str:
    return f"{100 * float(share):g}"
