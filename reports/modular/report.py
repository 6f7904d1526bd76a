"""The report on "Implementation of a Modular Linear and Unscented Kalman Filter" (MacCormack and Rubinstein, a poster):
what its filter bears of dropout, delay and ignorance, what it costs, and when its corrections land."""

from __future__ import annotations

from matplotlib.figure import Figure

from filters.systems.rocket import BURN_S
from filters.systems.spring_mass import period_s
from reports.charts.chart import gantt
from reports.drawing.picture import image
from reports.modular import oscillator, rocket, schedule, tables, words
from reports.modular.costs import cost_figure
from reports.modular.late import late_figure
from reports.modular.results import OWN_MODEL, SHOWN_PERIODS, Results
from reports.modular.rocket_rows import READINGS
from reports.modular.schedule_gantt import fix_panels
from reports.pages.render import csv_bytes, render
from studies.modular import oscillator as spring_mass
from studies.modular.late_measurements import SENSORS
from studies.modular.oscillator_run import OSCILLATOR
from studies.modular.rocket import BASE, PHASES
from studies.modular.rocket_schedule import compared_at, counted

TITLE = "Modular Kalman filters: what dropout, delay and ignorance do to them, what they cost, and when they land"


def build(found: Results) -> dict[str, bytes]:
    """All files of the report by name, as a pure function of what was simulated and measured."""
    rows = {
        "dropout": tables.dropout_rows(found),
        "claim": tables.claim_rows(found),
        "rates": tables.rate_rows(found),
        "sensors": tables.sensor_rows(found),
        "consistency": tables.consistency_rows(found),
        "rocket-errors": tables.rocket_error_rows(found),
        "readings": tables.reading_rows(found),
        "lost": tables.lost_rows(found),
        "rocket-nees": tables.rocket_nees_rows(found),
        "late": tables.late_rows(found),
        "parts": tables.part_rows(found),
        "processors": tables.verdict_on_processors(found),
        "spent": tables.spent_on(found),
    }
    figures = {name: image(figure, "svg") for name, figure in _figures(found).items()}
    pages = render(
        "modular",
        TITLE,
        figures,
        **{name.replace("-", "_"): table for name, table in rows.items()},
        points=words.sigma_point_words(),
        spring=words.oscillator_words(found),
        rocket=words.rocket_words(found),
        delayed=words.late_words(found),
        cost=words.cost_words(found),
        schedule=words.schedule_words(found),
    )
    return {**pages, **figures, **found.files(), **{f"{name}.csv": csv_bytes(table) for name, table in rows.items()}}


def _figures(found: Results) -> dict[str, Figure]:
    misses = schedule.miss_rows_of(found.records("schedule-misses"))
    half = {name: found.records("dropout", group=name, dropout="0.5")[0] for name in (OWN_MODEL, "usual")}
    return {
        "oscillator.svg": oscillator.history_figure(found.columns("oscillator"), SHOWN_PERIODS * period_s(OSCILLATOR)),
        "dropout.svg": oscillator.dropout_figure(found.records("dropout", group="usual")),
        "rates.svg": oscillator.rate_figure(
            {rate: found.records("dropout", group=tables.group_of(rate)) for rate in words.RATES}, spring_mass.reach()
        ),
        "consistency.svg": oscillator.nees_figure(
            found.columns("consistency"),
            {f"{row['runs']} runs": (float(row["low"]), float(row["high"])) for row in half.values()},
            {name: found.records("dropout", group=name) for name in ("usual", "less process noise", OWN_MODEL)},
        ),
        "flight.svg": rocket.flight_figure(found.columns("flight"), BURN_S),
        "residuals.svg": rocket.residual_figure(found.columns("rocket-residual-course"), READINGS),
        "rocket-consistency.svg": _rocket_consistency(found),
        "late.svg": late_figure({sensors: found.records("late", sensors=sensors) for sensors in SENSORS}),
        "parts.svg": cost_figure(found.records("parts")),
        "misses.svg": schedule.miss_figure(misses),
        "responses.svg": schedule.response_figure(found.columns("schedule-responses")),
        "landings.svg": schedule.landing_figure(found.columns("schedule-landings")),
        "one-fix.svg": gantt(fix_panels(counted(), compared_at(misses))),
    }


def _rocket_consistency(found: Results) -> Figure:
    rows = found.records("rocket-nees", case=BASE.name)
    bounds = {row["n"]: (float(row["low"]), float(row["high"])) for row in rows}
    of_phase = {
        phase: [(float(row["mean"]), float(row["se"])) for row in rows if row["phase"] == phase and row["of"] != "all"]
        for phase in PHASES
    }
    return rocket.nees_figure(found.columns("rocket-nees-course"), of_phase, bounds["15"], bounds["3"])
