"""The report on what late measurements cost at the output."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from reports.accuracy import tables
from reports.accuracy.figures import landing_figure, slow_figure
from reports.accuracy.front_figure import front_figure
from reports.accuracy.lead_figure import lead_figure
from reports.accuracy.results import EXAMPLE, Results
from reports.accuracy.words import MODELS, deviation, percents, plain_name, short_percents, unbroken
from reports.pages.numbers import significant
from reports.pages.pictures import files, pictures
from reports.pages.render import csv_bytes, render
from studies.accuracy.approximations import TAU_S
from studies.accuracy.given import MOTIONS
from studies.accuracy.landing import SEARCHED
from studies.accuracy.scale import EXACT, Placed, cheapest

TITLE = "Accuracy along the schedule: land later rather than skip fixes"
LEAST, MOST = "star-tracker", "camera"
"""The models of which the answer gives the numbers: that loses least, and that loses most."""
SPEED = Fraction(6)
"""Of the slow processor, that the text speaks of."""


def build(results: Results) -> dict[str, bytes]:
    """All files of the report by name, as a pure function of what the studies found."""
    rows = {
        "models": tables.models(results),
        "landings": tables.landings(results),
        "costs": tables.costs(results),
        "methods": tables.methods(results),
        "powers": tables.powers(results),
        "approximate": tables.approximate(results),
        "camera-rates": tables.camera_rates(results),
        "in-flight": tables.in_flight(results),
        "slow-processor": tables.slow_processor(results),
    }
    figures = pictures(
        {
            "answer.svg": lead_figure(results.landings),
            "landing.svg": landing_figure([*results.landings.values()]),
            "front.svg": front_figure(results.placed),
            "slow-processor.svg": slow_figure(results.choices),
        }
    )
    pages = render(
        "accuracy",
        TITLE,
        figures,
        **{name.replace("-", "_"): unbroken(table) for name, table in rows.items()},
        shown_methods=[unbroken(table) for table in tables.shown_methods(rows["methods"])],
        cost=_cost(results),
        power=_power(results),
        wrong=_wrong(results),
        slow=_slow(results),
    )
    return {
        **pages,
        **files(figures),
        **{f"{name}.csv": csv_bytes(table) for name, table in rows.items()},
        "all-landings.csv": csv_bytes(tables.all_landings(results)),
        "all-designs.csv": csv_bytes(tables.all_designs(results)),
        "all-choices.csv": csv_bytes(tables.all_choices(results)),
    }


def _cost(results: Results) -> dict[str, Any]:
    found = results.landings
    for loss in ("waiting", "leaving out"):
        order = sorted(found, key=lambda name: found[name].waiting if loss == "waiting" else found[name].leaving_out(2))
        if (order[0], order[-1]) != (LEAST, MOST):
            raise ValueError(f"other models than {LEAST} and {MOST} lose least and most by {loss}, against the answer")
    if not all(of.waiting < of.leaving_out(2) / 2 for of in found.values()):
        raise ValueError("a model loses more by landing at the next fix than half of what skipping costs")
    if not all(of.waiting < of.rule for of in found.values()):
        raise ValueError("the screening rule is below what landing later costs, which the report calls its bound")
    return {
        "waiting": {name: short_percents(of.waiting) for name, of in found.items()},
        "second": {name: short_percents(of.leaving_out(2)) for name, of in found.items()},
        "until": {name: f"{of.given.ms(of.as_late):g}" for name, of in found.items() if of.as_late is not None},
        "beyond_s": f"{found['star-tracker'].given.ms(SEARCHED * found['star-tracker'].given.N) / 1000:g}",
        "times": [f"{of.rule / of.waiting:.1f}" for of in sorted(found.values(), key=lambda of: of.rule / of.waiting)],
    }


def _power(results: Results) -> dict[str, Any]:
    least = cheapest(results.placed[EXAMPLE])
    skipping = [place for placed in results.placed.values() for place in placed if place.every > 1 and place.on_front]
    if skipping:
        raise ValueError("a design that skips measurements is best for its power, which the report denies")
    best: dict[str, list[str]] = {}
    for name, placed in results.placed.items():
        methods = list(dict.fromkeys(place.method for place in sorted(placed, key=_speed) if place.on_front))
        best.setdefault(" and ".join(f"*{plain_name(method)}*" for method in methods), []).append(MODELS[name].name)
    return {
        "of": {method: tables.operations(place.speed) for method, place in least.items()},
        "times": {method: significant(place.speed / least["standard"].speed) for method, place in least.items()},
        "lands": {method: place.lands for method, place in least.items()},
        "best": best,
        "exact": len(EXACT),
    }


def _speed(place: Placed) -> Fraction:
    return place.speed


def _wrong(results: Results) -> dict[str, Any]:
    found = results.approximations
    if any(of.discarded.verdict != "diverges" for of in found.values()):
        raise ValueError("a model's own error is bounded without measurements, which the report denies")
    px4 = {name: (of.px4.worst / of.exact.worst - 1, of.px4.rms / of.exact.rms - 1) for name, of in found.items()}
    noises = [
        approximate.worst / of.exact_late.worst - 1 for of in found.values() for approximate in (of.summed, of.halved)
    ]
    return {
        "tau": f"{TAU_S:g}",
        "px4": {name: [percents(share) for share in shares] for name, shares in px4.items()},
        "times": significant(found["camera"].px4.worst / found["camera"].exact.worst, 2),
        "at_2_hz": percents(results.noise_by_rate[2]),
        "at_2_hz_early": percents(results.noise_on_arrival),
        "camera_delay_ms": f"{found['camera'].given.ms(found['camera'].given.M):g}",
        "largest_noise": _at_most(max(noises)),
        "bias": deviation(EXAMPLE, found[EXAMPLE].fresh.bias),
        "fresh": deviation(EXAMPLE, found[EXAMPLE].fresh.total),
        "exact": deviation(EXAMPLE, found[EXAMPLE].exact.worst),
        "believed": deviation(EXAMPLE, found[EXAMPLE].fresh.believed or 0.0),
        "motions": _motions(),
    }


def _motions() -> list[str]:
    by_text: dict[str, list[str]] = {}
    for name, motion in MOTIONS.items():
        by_text.setdefault(motion.what, []).append(MODELS[name].name)
    return [f"{' and '.join(names)}: {text}" for text, names in by_text.items()]


def _at_most(share: float) -> str:
    """A share in percent, rounded up to one digit of thousandths."""
    if not share < 1e-5:
        raise ValueError("Q' or Q'' costs more than 0.001 % in a shipped model, which the report denies")
    return "0.001"


def _slow(results: Results) -> dict[str, Any]:
    alone, several = tables.at_speeds_of(results.choices)[SPEED]
    assert alone is not None
    first = next(choice for choice in results.choices if choice.every == 1 and not choice.several and choice.L == 4)
    return {
        "speed": f"{float(SPEED):g}",
        "alone": (alone.every, alone.L, significant(1000 * alone.worst)),
        "several": (several.every, several.L, significant(1000 * several.worst)),
        "better": significant(100 * (1 - several.worst / alone.worst)),
        "first_alone": f"{float(first.speed):g}",
    }
