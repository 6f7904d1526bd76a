"""The numbers in the text of the report on modular filters."""

from __future__ import annotations

from typing import Any

from filters.modular.sigma_points import maccormack, merwe, weights
from filters.systems.rocket import BURN_S, RATE_HZ
from filters.systems.spring_mass import period_s
from reports.modular_costs import OPERATIONS, SECONDS
from reports.modular_results import HALF, OWN_MODEL, SHOWN_PERIODS, Results
from reports.modular_rocket_rows import CASES
from reports.modular_schedule import miss_rows_of
from reports.modular_tables import group_of, over, percent_of_amplitude
from reports.multirate_words import significant
from studies import late_measurements, modular_costs, rocket, rocket_schedule, spring_mass
from studies.rocket_schedule import GPS_DELAYS as DELAYS
from studies.rocket_schedule import compared_at
from studies.spring_mass_run import OSCILLATOR, PERIODS, SETTLED_PERIODS

STATES = (3, 15)
"""Lengths of the errors of the two modalities."""


def sigma_point_words() -> dict[str, Any]:
    """The document's weights beside those of Merwe, with alpha = 1, beta = 2 and the kappa that each form has."""
    found: dict[str, Any] = {}
    for form in (maccormack(), merwe()):
        of = [weights(form, n) for n in STATES]
        found[form.form] = {
            "spread": [f"{each.spread:.3g}" for each in of],
            "mean_0": [f"{each.mean_0:.3g}" for each in of],
            "covariance_0": [f"{each.covariance_0:.3g}" for each in of],
            "difference": [f"{each.covariance_0 - each.mean_0:.3g}" for each in of],
            "kappa": f"{form.kappa:g}",
        }
    return found


def oscillator_words(found: Results) -> dict[str, Any]:
    """What was found of the oscillator."""
    usual = {row["dropout"]: row for row in found.records("dropout", group="usual")}
    keen = {row["dropout"]: row for row in found.records("dropout", group="less process noise")}
    own = {row["dropout"]: row for row in found.records("dropout", group=OWN_MODEL)}
    low, high = usual["0.1"], usual["0.8"]
    by_rate = {rate: {row["dropout"]: row for row in found.records("dropout", group=group_of(rate))} for rate in RATES}
    return {
        "runs": low["runs"],
        "periods": PERIODS,
        "settled": SETTLED_PERIODS,
        "shown": SHOWN_PERIODS,
        "half": f"{100 * HALF:g}",
        "period_s": f"{period_s(OSCILLATOR):.2f}",
        "error": {dropout: percent_of_amplitude(row, "position") for dropout, row in usual.items()},
        "times": {dropout: over(row, low, "error m") for dropout, row in usual.items()},
        "speed_times": over(high, low, "error m_s"),
        "jerky_times": over(high, low, "error m_s2"),
        "innovation": over(high, low, "innovation m"),
        "felt": over(high, low, "innovation m_s2"),
        "after": over(high, low, "after m"),
        "reach": f"{spring_mass.reach():.2f}",
        "borne": {rate: f"{100 * spring_mass.borne(rate):.0f}" for rate in RATES},
        "rate_error": {rate: percent_of_amplitude(rows["0.8"], "position") for rate, rows in by_rate.items()},
        "rate_times": {rate: over(rows["0.8"], rows["0.1"], "error m") for rate, rows in by_rate.items()},
        "gap": f"{spring_mass.BORNE:g}",
        "nees": {name: rows["0.5"] for name, rows in (("usual", usual), ("keen", keen), ("own", own))},
        "keen_high": keen["0.8"],
        "keen_error": percent_of_amplitude(keen["0.8"], "position"),
        "keen_late": keen["0.95"]["nees"],
    }


RATES = sorted({*spring_mass.RATES, spring_mass.USUAL.rate})


def rocket_words(found: Results) -> dict[str, Any]:
    """What was found of the rocket."""
    errors = {row["case"]: row for row in found.records("rocket-errors")}
    base, lossy = errors[rocket.BASE.name], errors[CASES["95 %"]]
    apogee = found.columns("rocket-apogee")["apogee_m"]
    nees = {
        (dropout, row["phase"]): row
        for dropout, case in CASES.items()
        for row in found.records("rocket-nees", case=case, of="all")
    }
    (onset,) = found.records("rocket-nees", case=rocket.BASE.name, phase="thrust onset", of="acceleration")
    readings = {
        dropout: {row["reading"]: row for row in found.records("rocket-residuals", case=case)}
        for dropout, case in CASES.items()
    }
    return {
        "flights": base["runs"],
        "few": len(rocket.FEW_SEEDS),
        "apogee": [f"{float(height):,.0f}" for height in (apogee.min(), apogee.max())],
        "burn": f"{BURN_S:g}",
        "claim": f"{rocket.CLAIM_PERCENT:g}",
        "base": base,
        "errors": errors,
        "lossy": lossy,
        "readings": readings,
        "from_s": {
            dropout: {name: _time(row["holds from s"]) for name, row in of.items()} for dropout, of in readings.items()
        },
        "hold": {
            dropout: {name: f"{float(row['runs hold']):.0f}" for name, row in of.items()}
            for dropout, of in readings.items()
        },
        "onset": onset["mean"],
        "nees": {
            dropout: {phase: significant(float(row["mean"])) for (of, phase), row in nees.items() if of == dropout}
            for dropout in CASES
        },
        "bounds": nees["0 %", "coast"],
    }


def late_words(found: Results) -> dict[str, Any]:
    """What was found of late measurements."""
    of = {(row["sensors"], row["way"], int(row["delay"])): row for row in found.records("late")}
    alone, both = late_measurements.SENSORS

    def percent(sensors: str, way: str, delay: int) -> str:
        return significant(100 * float(of[sensors, way, delay]["error"]))

    longest = {way: int(of[both, way, 10]["longest"]) for way in ("recalculate", "larsen", "as new")}
    return {
        "runs": of[both, "larsen", 0]["runs"],
        "rate": late_measurements.SETTING.rate,
        "every": late_measurements.EVERY,
        "in_time": {"alone": percent(alone, "as new", 0), "both": percent(both, "as new", 0)},
        "late": {
            way: {"alone": percent(alone, way, 10), "both": percent(both, way, 10)} for way in ("recalculate", "as new")
        },
        "soon": {way: percent(alone, way, 2) for way in ("recalculate", "as new")},
        "dual": percent(alone, "dual-rate", 2),
        "peak": significant(longest["recalculate"] / longest["as new"]),
        "larsen_peak": significant(longest["larsen"] / longest["as new"]),
    }


def cost_words(found: Results) -> dict[str, Any]:
    """Ratios of costs; those of times are marked in the text."""
    of = {(row["kind"], row["part"], int(row["states"])): row for row in found.records("parts")}
    (machine,) = found.records("machine")

    def ratio(column: str, part: str, states: int) -> str:
        return significant(
            float(of["unscented", part, states][column]) / float(of["extended", part, states][column]), 2
        )

    shown = (3, 15)
    return {
        "machine": {name.removesuffix(" †"): value for name, value in machine.items()},
        "counted": {part: [ratio(OPERATIONS, part, states) for states in shown] for part in modular_costs.PARTS},
        "timed": {part: [ratio(SECONDS, part, states) for states in shown] for part in modular_costs.PARTS},
        "largest": of["unscented", "predict", 15][SECONDS],
    }


def schedule_words(found: Results) -> dict[str, Any]:
    """How the rocket's filter fares on slower processors; all of it by measured times."""
    misses = miss_rows_of(found.records("schedule-misses"))
    at = compared_at(misses)
    urgent, preempted = "in the loop", "preempted"
    there = {(row.way, row.urgency, row.job): row for row in misses if row.times_slower == at}
    names = dict(zip(("unscented", "extended", "larsen"), (way.name for way in rocket_schedule.WAYS), strict=True))
    spent = {(row["late GPS fix"], row["its correction"]): row for row in found.records("schedule-shares")}
    response = "GPS response, median (ms)"
    return {
        "at": at,
        "rate": RATE_HZ,
        "fix_hz": RATE_HZ // rocket_schedule.GPS_EVERY,
        "delays": [f"{rocket_schedule.PERIOD_MS * delay:g}" for delay in (min(DELAYS), max(DELAYS))],
        "dropout": f"{100 * rocket_schedule.DROPOUT:g}",
        "land_by": f"{rocket_schedule.PERIOD_MS * (rocket_schedule.LAND_BY + 1):g}",
        "bearable": f"{100 * rocket_schedule.BEARABLE:g}",
        "holds": {
            short: {
                urgency: rocket_schedule.slowest_that_holds(misses, name, urgency) or "none"
                for urgency in (urgent, preempted)
            }
            for short, name in names.items()
        },
        "loop": f"{100 * there[names['extended'], urgent, 'loop'].probability:.1f}",
        "loop_late": f"{there[names['extended'], urgent, 'loop'].late_ms:.0f}",
        "busy": f"{100 * there[names['extended'], urgent, 'loop'].utilization:.0f}",
        "response": {short: spent[name, preempted][response] for short, name in names.items()},
    }


def _time(seconds: str) -> str:
    return "never" if seconds == "inf" else f"{float(seconds):.2g}"
