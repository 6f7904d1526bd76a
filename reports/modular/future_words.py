"""The numbers in the text on the poster's future work, and on residuals against time."""

from __future__ import annotations

from typing import Any

from filters.systems.spring_mass import frequency
from reports.modular.future_rows import QUANTILES
from reports.modular.future_tables import in_percent, interval_of
from reports.modular.results import Results
from reports.pages.numbers import between, significant
from studies.modular import found_covariances, parameter_state, rocket, rocket_schedule, uncertain
from studies.modular.oscillator import SEEDS, USUAL
from studies.modular.oscillator_run import ACCELERATION_SIGMA, OSCILLATOR, step_s
from studies.modular.residual_course import DROPOUTS


def residual_time_words(results: Results) -> dict[str, Any]:
    """Of a typical run, in the last tenth of a period."""
    last = {str(lost): results.records("residual-course", dropout=str(lost))[-1] for lost in DROPOUTS}
    return {
        "runs": last["0.1"]["runs"],
        "error": {lost: in_percent(row, "error") for lost, row in last.items()},
    }


def future_words(results: Results) -> dict[str, Any]:
    """Uncertain parameters, the stiffness as a state, covariances found."""
    spread = f"{uncertain.SPREADS[-1]:g}"
    (swings,) = results.records("uncertain", of="oscillator", spread=spread, dropout=f"{uncertain.DROPOUTS[-1]:g}")
    (flights,) = results.records("uncertain", of="rocket", spread=spread)
    stiffness = {row["dropout"]: row for row in results.records("stiffness")}
    model, oscillator = (results.records("covariances", truth=truth)[0] for truth in found_covariances.TRUTHS)
    return {
        "spread": f"{100 * uncertain.SPREADS[-1]:g}",
        "swings": between(*interval_of(swings, "times")),
        "swings_unlucky": between(*interval_of(swings, "unlucky")),
        "flown": between(*interval_of(flights, "times")),
        "flown_unlucky": between(*interval_of(flights, "unlucky")),
        "told": f"{100 * parameter_state.SIGMA / parameter_state.NOMINAL:.0f}",
        "each": f"{100 * parameter_state.SPREAD:g}",
        "unaware": {lost: in_percent(row, "unaware") for lost, row in stiffness.items()},
        "aware": {lost: in_percent(row, "aware") for lost, row in stiffness.items()},
        "off": f"{100 * float(stiffness['0.8']['stiffness']):.2g}",
        "fits": model["fits"],
        "seen": found_covariances.RUNS,
        "factor": f"{found_covariances.FACTOR:g}",
        "drowned": f"{frequency(OSCILLATOR) ** 2.5 * step_s(USUAL) ** 0.5 / float(ACCELERATION_SIGMA):.0f}",
        "lowest": significant(float(model[f"acceleration {QUANTILES[0]}"])),
        "highest": significant(float(model[f"acceleration {QUANTILES[2]}"])),
        "half": between(*interval_of(oscillator, f"acceleration {QUANTILES[1]}")),
        "jerk": between(*interval_of(oscillator, f"jerk {QUANTILES[1]}")),
        "times": {
            "model": between(*interval_of(model, "times")),
            "oscillator": between(*interval_of(oscillator, "times")),
        },
        "own_nees": {
            "model": between(*interval_of(model, "nees")),
            "oscillator": between(*interval_of(oscillator, "nees")),
        },
        "usual_nees": between(*interval_of(oscillator, "usual nees")),
    }


def made_words() -> dict[str, Any]:
    """The seeds."""
    return {
        "last_run": SEEDS[-1],
        "last_flight": rocket.SEEDS[-1],
        "last_uncertain": uncertain.ROCKET_SEEDS[-1],
        "schedule_seed": rocket_schedule.SEED,
        "last_fit": (found_covariances.RUNS + 1) * found_covariances.FITS - 1,
    }
