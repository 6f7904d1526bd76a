"""The numbers in the text of the report on modular filters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from filters.modular.sigma_points import maccormack, merwe, weights
from filters.systems.rocket import BURN_S, RATE_HZ
from filters.systems.spring_mass import period_s
from reports.modular.costs import OPERATIONS
from reports.modular.gap_words import gap_words
from reports.modular.oscillator import QUANTITIES
from reports.modular.results import HALF, OWN_MODEL, SHOWN_PERIODS, Results
from reports.modular.rocket import QUANTITIES as OF_ROCKET
from reports.modular.rocket_rows import CASES
from reports.modular.schedule import miss_rows_of, missed_percent
from reports.modular.schedule_gantt import clocks_shown
from reports.modular.tables import (
    group_of,
    interval_of,
    late_error,
    nees_of,
    over,
    percent_of_amplitude,
    rocket_error,
)
from reports.pages.machine import legend, timed_on
from reports.pages.measurements import counted_on, who_measured
from reports.pages.numbers import plus_minus, significant, span
from reports.pages.stored import digits
from sched_sim.processors.part_file import load_part
from studies.machines.parts import PartTimes
from studies.machines.ranges import range_of
from studies.modular import (
    costs as modular_costs,
)
from studies.modular import (
    late_measurements,
    rocket,
    rocket_schedule,
)
from studies.modular import (
    oscillator as spring_mass,
)
from studies.modular.oscillator_run import AMPLITUDES, OSCILLATOR, PERIODS, POSITION_SIGMA_M, SETTLED_PERIODS
from studies.modular.rocket_schedule import GPS_DELAYS as DELAYS
from studies.modular.rocket_schedule import MissRow, compared_at

STATES = (3, 15)
"""Lengths of the errors of the two modalities."""


def sigma_point_words() -> dict[str, Any]:
    """The document's weights beside those of Merwe, with alpha = 1, beta = 2 and the kappa that each form has."""
    by_form: dict[str, Any] = {}
    for form in (maccormack(), merwe()):
        points = [weights(form, n) for n in STATES]
        by_form[form.form] = {
            "spread": [f"{each.spread:.3g}" for each in points],
            "mean_0": [f"{each.mean_0:.3g}" for each in points],
            "covariance_0": [f"{each.covariance_0:.3g}" for each in points],
            "difference": [f"{each.covariance_0 - each.mean_0:.3g}" for each in points],
            "kappa": f"{form.kappa:g}",
        }
    return by_form


def oscillator_words(results: Results) -> dict[str, Any]:
    """What was found of the oscillator: typical runs, with their intervals."""
    usual, keen, own = (
        {row["dropout"]: row for row in results.records("dropout", group=group)}
        for group in ("usual", "less process noise", OWN_MODEL)
    )
    by_rate = {
        rate: {row["dropout"]: row for row in results.records("dropout", group=group_of(rate))} for rate in RATES
    }
    few, sensors = by_rate[RATES[0]]["0.8"], results.records("dropout", group="position only")
    high = usual["0.8"]
    return {
        "runs": high["runs"],
        "sensor_runs": sensors[0]["runs"],
        "periods": PERIODS,
        "settled": SETTLED_PERIODS,
        "shown": SHOWN_PERIODS,
        "half": f"{100 * HALF:g}",
        "period_s": f"{period_s(OSCILLATOR):.2f}",
        "inside": [f"{100 * share:.0f}" for share in _inside(results)],
        "rate": spring_mass.USUAL.rate,
        "amplitude": f"{AMPLITUDES[0]:g}",
        "noise": f"{100 * float(POSITION_SIGMA_M / AMPLITUDES[0]):g}",
        "error": {dropout: percent_of_amplitude(row, "position") for dropout, row in usual.items()},
        "times": {dropout: over(row, "error", "position") for dropout, row in usual.items()},
        "plain_times": significant(interval_of(high, "error", "position", "times")[0], 2),
        "innovation": over(high, "innovation", "position"),
        "felt": over(high, "innovation", "acceleration"),
        "after": over(high, "after", "position"),
        "reach": f"{spring_mass.reach():.2f}",
        "few": RATES[0],
        "bounds_of": [rows["0.5"]["runs"] for rows in (usual, own)],
        "few_error": percent_of_amplitude(few, "position"),
        "without_acceleration": percent_of_amplitude(
            results.records("dropout", group="acceleration only")[-1], "position"
        ),
        "least_times": significant(
            min(interval_of(rows["0.8"], "error", "position", "times")[1] for rows in by_rate.values())
        ),
        **gap_words({rate: [*rows.values()] for rate, rows in by_rate.items()}),
        "seen_at_the_gap": f"{1 / spring_mass.BORNE:g}",
        "fewer": f"{FEWER:g}",
        "mean_of_fewer": f"{FEWER**0.5:.1f}",
        "gap": f"{spring_mass.BORNE:g}",
        "nees": {name: nees_of(rows["0.5"]) for name, rows in (("usual", usual), ("own", own))},
        "keen_error": percent_of_amplitude(keen["0.8"], "position"),
        "keen_late": nees_of(keen["0.95"]),
    }


def _inside(results: Results) -> list[float]:
    """Shares of the steps of the run that is drawn whose error is within twice its standard deviation."""
    run = results.columns("oscillator")
    return [
        float(np.mean(np.abs(run[f"{name} estimate"] - run[f"{name} true"]) <= 2 * run[f"{name} sigma"]))
        for name in QUANTITIES
    ]


FEWER = 4.5
"""Times fewer measurements get through at 80 % dropout than at 10 %."""
RATES = sorted({*spring_mass.RATES, spring_mass.USUAL.rate})


def rocket_words(results: Results) -> dict[str, Any]:
    """What was found of the rocket: typical flights, with their intervals."""
    errors = {row["case"]: row for row in results.records("rocket-errors")}
    base, lossy = errors[rocket.BASE.name], errors[CASES["95 %"]]
    apogee = results.columns("rocket-apogee")["apogee_m"]
    nees = {
        (dropout, row["phase"]): row
        for dropout, case in CASES.items()
        for row in results.records("rocket-nees", case=case, of="all")
    }
    (onset,) = results.records("rocket-nees", case=rocket.BASE.name, phase="thrust onset", of="acceleration")
    readings = {
        dropout: {row["reading"]: row for row in results.records("rocket-residuals", case=case)}
        for dropout, case in CASES.items()
    }
    blind = errors["no accelerometer"]
    tuned = [rocket_error(errors[case.name], "position") for case in rocket.NOISE_CASES]
    return {
        "flights": base["runs"],
        "few": len(rocket.FEW_SEEDS),
        "apogee": [f"{float(height):,.0f}" for height in (apogee.min(), apogee.max())],
        "burn": f"{BURN_S:g}",
        "claim": f"{rocket.CLAIM_PERCENT:g}",
        "position": rocket_error(base, "position"),
        "orientation": rocket_error(base, "orientation"),
        "velocity": rocket_error(base, "velocity"),
        "largest_angle": base["orientation largest"],
        "blind_velocity": rocket_error(blind, "velocity"),
        "blind_position": rocket_error(blind, "position"),
        "lossy": rocket_error(lossy, "position"),
        "tuned": tuned,
        "without_gps": rocket_error(errors["no GPS"], "position"),
        "from_s": {
            dropout: {name: _time(row["holds from s"]) for name, row in rows.items()}
            for dropout, rows in readings.items()
        },
        "onset": plus_minus(float(onset["mean"]), float(onset["se"])),
        "nees": {
            dropout: {
                phase: plus_minus(float(row["mean"]), float(row["se"]))
                for (lost, phase), row in nees.items()
                if lost == dropout
            }
            for dropout in CASES
        },
        "alike": _alike(errors),
    }


def _alike(errors: Mapping[str, Mapping[str, str]]) -> str:
    """How far the typical errors of the extended and of the unscented filter are apart, in words."""
    pairs = ((rocket.EXTENDED.name, rocket.BASE.name), (rocket.EXTENDED_DROPOUT.name, CASES["95 %"]))
    ratios = [float(errors[first][name]) / float(errors[second][name]) for first, second in pairs for name in OF_ROCKET]
    most = max(abs(ratio - 1) for ratio in ratios)
    return f"differ by up to {100 * most:.1f} %" if most else "are the same to three digits"


def late_words(results: Results) -> dict[str, Any]:
    """What was found of late measurements."""
    rows = {(row["sensors"], row["way"], int(row["delay"])): row for row in results.records("late")}
    alone, both = late_measurements.SENSORS

    def percent(sensors: str, way: str, delay: int) -> str:
        return late_error(rows[sensors, way, delay])

    longest = {way: int(rows[both, way, 10]["longest"]) for way in ("recalculate", "larsen", "fuse-as-fresh")}
    return {
        "runs": rows[both, "larsen", 0]["runs"],
        "rate": late_measurements.SETTING.rate,
        "every": late_measurements.EVERY,
        "in_time": {"alone": percent(alone, "fuse-as-fresh", 0), "both": percent(both, "fuse-as-fresh", 0)},
        "late": {
            way: {"alone": percent(alone, way, 10), "both": percent(both, way, 10)}
            for way in ("recalculate", "fuse-as-fresh")
        },
        "soon": {way: percent(alone, way, 2) for way in ("recalculate", "fuse-as-fresh")},
        "dual": percent(alone, "dual-rate", 2),
        "peak": significant(longest["recalculate"] / longest["fuse-as-fresh"]),
        "larsen_peak": significant(longest["larsen"] / longest["fuse-as-fresh"]),
    }


def cost_words(results: Results) -> dict[str, Any]:
    """Ratios of costs; those of times are marked in the text."""
    rows = {(row["kind"], row["part"], int(row["states"])): row for row in results.records("parts")}

    def counted(part: str, states: int) -> str:
        unscented, extended = (float(rows[kind, part, states][OPERATIONS]) for kind in ("unscented", "extended"))
        return significant(unscented / extended, 2)

    def timed(part: modular_costs.Part, states: int) -> str:
        """By the least times, over all measurements."""

        def ratio(times: PartTimes) -> float:
            return times.parts["unscented", str(states), part].least / times.parts["extended", str(states), part].least

        return span(*(significant(end, 2) for end in range_of(ratio, results.measurements)))

    shown = (3, 15)
    return {
        "legend": legend(timed_on(results.measured.provenance)),
        "who_measured": who_measured(results.measurements),
        "measured_on": counted_on(results.measurements),
        "counted": {part: [counted(part, states) for states in shown] for part in modular_costs.PARTS},
        "timed": {part: [timed(part, states) for states in shown] for part in modular_costs.PARTS},
        "largest": span(*map(digits, results.least("unscented", 15, "predict"))),
    }


def schedule_words(results: Results) -> dict[str, Any]:
    """How the rocket's filter fares on slower processors."""
    misses = miss_rows_of(results.records("schedule-misses"))
    at = compared_at(misses)
    urgent, preempted = "in the loop", "preempted"
    there = {(row.way, row.urgency, row.job): row for row in misses if row.clock_mhz == at}
    names = dict(zip(("unscented", "extended", "larsen"), (way.name for way in rocket_schedule.WAYS), strict=True))
    spent = {(row["late GPS fix"], row["its correction"]): row for row in results.records("schedule-shares")}
    response, loop = "GPS response, median (ms)", there[names["extended"], urgent, "loop"]
    return {
        "at": at,
        "part": load_part(rocket_schedule.PROCESSOR).title.partition(" at ")[0],
        "spread": [f"{float(edge(rocket_schedule.SPREAD)):g}" for edge in (min, max)],
        "clocks": ", ".join(map(str, sorted({row.clock_mhz for row in misses}))),
        "steps": f"{rocket_schedule.STEPS:,}",
        "fixes": f"{misses[0].cycles:,}",
        "rate": RATE_HZ,
        "fix_hz": RATE_HZ // rocket_schedule.GPS_EVERY,
        "delays": [f"{rocket_schedule.PERIOD_MS * delay:g}" for delay in (min(DELAYS), max(DELAYS))],
        "dropout": f"{100 * rocket_schedule.DROPOUT:g}",
        "land_by": f"{rocket_schedule.PERIOD_MS * (rocket_schedule.LAND_BY + 1):g}",
        "bearable": f"{100 * rocket_schedule.BEARABLE:g}",
        "holds": {
            short: {
                urgency: rocket_schedule.slowest_that_holds(misses, name, urgency) or "none of the clocks tried"
                for urgency in (urgent, preempted)
            }
            for short, name in names.items()
        },
        "loop": missed_percent(loop),
        "loop_late": f"{loop.late_ms:.0f}",
        "busy": f"{100 * loop.utilization:.0f}",
        "clocks_shown": [edge(clocks_shown(misses)) for edge in (min, max)],
        "first": _first_late(misses, names["extended"], preempted),
        "response": {short: spent[name, preempted][response] for short, name in names.items()},
    }


def _first_late(rows: Iterable[MissRow], way: str, urgency: str) -> str:
    """Which job misses most on the fastest clock that does not hold."""
    held = rocket_schedule.slowest_that_holds(rows, way, urgency)
    slower = [row for row in rows if (row.way, row.urgency) == (way, urgency) and row.clock_mhz < (held or np.inf)]
    clock_mhz = max(row.clock_mhz for row in slower)
    job = max((row for row in slower if row.clock_mhz == clock_mhz), key=lambda row: row.probability).job
    return {"loop": "the loop", "control": "the control task", "GPS": "the GPS correction itself"}[job]


def _time(seconds: str) -> str:
    return "never" if seconds == "inf" else f"{float(seconds):.2g}"
