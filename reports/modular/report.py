"""The report on "Implementation of a Modular Linear and Unscented Kalman Filter" (MacCormack and Rubinstein, a poster):
what its filter bears of dropout, delay and ignorance, what it costs, and when its corrections land."""

from __future__ import annotations

from matplotlib.figure import Figure

from filters.systems.rocket import BURN_S
from filters.systems.spring_mass import period_s
from reports.modular import (
    biases,
    future,
    future_tables,
    future_words,
    oscillator,
    rocket,
    schedule,
    shared_code,
    tables,
    words,
)
from reports.modular.costs import cost_figure
from reports.modular.gap import gap_figure
from reports.modular.late import late_figure
from reports.modular.residual_time import residual_time_figure
from reports.modular.results import OWN_MODEL, SHOWN_PERIODS, Results
from reports.modular.rocket_rows import READINGS
from reports.modular.schedule_gantt import clocks_shown, fix_frames, fix_rows
from reports.modular.setting_words import setting_words
from reports.pages.pictures import Sliding, files, pictures
from reports.pages.render import csv_bytes, render
from studies.modular import oscillator as spring_mass
from studies.modular.late_measurements import SENSORS
from studies.modular.oscillator_run import OSCILLATOR
from studies.modular.rocket import BASE, PHASES
from studies.modular.rocket_schedule import compared_at, counted

TITLE = "Modular Kalman filters: what they bear of dropout and delay, what they cost, when they land"


def build(results: Results) -> dict[str, bytes]:
    """All files of the report by name, as a pure function of what was simulated and measured."""
    rows = {
        "dropout": tables.dropout_rows(results),
        "claim": tables.claim_rows(results),
        "rates": tables.rate_rows(results),
        "sensors": tables.sensor_rows(results),
        "consistency": tables.consistency_rows(results),
        "rocket-errors": tables.rocket_error_rows(results),
        "readings": tables.reading_rows(results),
        "lost": tables.lost_rows(results),
        "biases": biases.bias_table(results),
        "rocket-nees": tables.rocket_nees_rows(results),
        "late": tables.late_rows(results),
        "parts": tables.part_rows(results),
        "measurements": tables.measurement_rows_of(results),
        "systems": shared_code.system_rows(),
        "compiled": shared_code.flight_rows(results),
        "processors": tables.verdict_on_processors(results),
        "spent": tables.spent_on(results),
        "residual-time": future_tables.residual_time_rows(results),
        "uncertain": future_tables.uncertain_rows(results),
        "stiffness": future_tables.stiffness_rows(results),
        "covariances": future_tables.covariance_rows(results),
    }
    misses = schedule.miss_rows_of(results.records("schedule-misses"))
    fixes = fix_frames(counted(), clocks_shown(misses))
    rows["one-fix"] = fix_rows(fixes)
    fix = Sliding("clock of the processor", [*fixes.values()], [*fixes].index(compared_at(misses)))
    figures = pictures({**_figures(results), "one-fix.svg": fix})
    pages = render(
        "modular",
        TITLE,
        figures,
        **{name.replace("-", "_"): table for name, table in rows.items()},
        rocket_errors_shown=tables.without(rows["rocket-errors"], "flights", "acceleration", "turn rate"),
        late_shown=tables.without(rows["late"], "4 late", "6 late"),
        stiffness_shown=tables.without(rows["stiffness"], future_tables.STIFFNESS),
        parts_counted=tables.without(rows["parts"], *tables.TIMED),
        parts_timed=tables.without(rows["parts"], *tables.COUNTED),
        points=words.sigma_point_words(),
        course=future_words.residual_time_words(results),
        future=future_words.future_words(results),
        made=future_words.made_words(),
        spring=words.oscillator_words(results),
        rocket=words.rocket_words(results),
        setting=setting_words(results),
        biases_shown=tables.without(rows["biases"], "orientation from s"),
        biased=biases.bias_words(results),
        code=shared_code.shared_code_words(results),
        delayed=words.late_words(results),
        cost=words.cost_words(results),
        schedule=words.schedule_words(results),
    )
    return {
        **pages,
        **files(figures),
        **results.files(),
        **{f"{name}.csv": csv_bytes(table) for name, table in rows.items()},
    }


def _figures(results: Results) -> dict[str, Figure]:
    misses = schedule.miss_rows_of(results.records("schedule-misses"))
    half = {name: results.records("dropout", group=name, dropout="0.5")[0] for name in (OWN_MODEL, "usual")}
    return {
        "oscillator.svg": oscillator.history_figure(
            results.columns("oscillator"), SHOWN_PERIODS * period_s(OSCILLATOR)
        ),
        "dropout.svg": oscillator.dropout_figure(results.records("dropout", group="usual")),
        "residual-time.svg": residual_time_figure(results.columns("residual-run"), results.records("residual-course")),
        "rates.svg": gap_figure(
            {rate: results.records("dropout", group=tables.group_of(rate)) for rate in words.RATES},
            1 / spring_mass.BORNE,
        ),
        "consistency.svg": oscillator.nees_figure(
            results.columns("consistency"),
            {f"{row['runs']} runs": (float(row["low"]), float(row["high"])) for row in half.values()},
            {name: results.records("dropout", group=name) for name in ("usual", "less process noise", OWN_MODEL)},
        ),
        "flight.svg": rocket.flight_figure(results.columns("flight"), BURN_S),
        "residuals.svg": rocket.residual_figure(results.columns("rocket-residual-course"), READINGS),
        **_rocket_consistency(results),
        "stiffness.svg": future.stiffness_figure(results.records("stiffness")),
        "covariances.svg": future.covariance_figure(results.records("covariances")),
        "late.svg": late_figure({sensors: results.records("late", sensors=sensors) for sensors in SENSORS}),
        "parts.svg": cost_figure(results.records("parts"), results.measurements),
        "misses.svg": schedule.miss_figure(misses),
        "responses.svg": schedule.response_figure(results.columns("schedule-responses")),
        "landings.svg": schedule.landing_figure(results.columns("schedule-landings")),
    }


def _rocket_consistency(results: Results) -> dict[str, Figure]:
    rows = results.records("rocket-nees", case=BASE.name)
    bounds = {row["n"]: (float(row["low"]), float(row["high"])) for row in rows}
    of_phase = {
        phase: [(float(row["mean"]), float(row["se"])) for row in rows if row["phase"] == phase and row["of"] != "all"]
        for phase in PHASES
    }
    return {
        "rocket-consistency.svg": rocket.nees_figure(results.columns("rocket-nees-course"), bounds["15"]),
        "rocket-phases.svg": rocket.phase_figure(of_phase, bounds["3"]),
    }
