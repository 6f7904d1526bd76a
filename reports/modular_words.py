"""The numbers in the text of the report on modular filters."""

from __future__ import annotations

from typing import Any

from filters.modular.sigma_points import maccormack, merwe, weights
from filters.systems.spring_mass import period_s
from reports.modular_results import HALF, OWN_MODEL, SHOWN_PERIODS, Results
from reports.modular_tables import group_of, over, percent_of_amplitude
from studies import spring_mass
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
