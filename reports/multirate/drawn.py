"""The figures of the report on the multirate gain, from what its studies found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from matplotlib.figure import Figure

from reports.multirate.costs import Form, least_period, least_time_of, time_of
from reports.multirate.gain_figure import gain_figure
from reports.multirate.lead_figure import lead_figure
from reports.multirate.limit_figure import limit_figure
from reports.multirate.limits import Limits
from reports.multirate.load_figure import Printed, load_figure
from reports.multirate.results import PERIODS, Results
from reports.multirate.start_figure import start_figure
from reports.multirate.steady_figures import Point, readings_figure, rule_figure
from reports.multirate.tables import CASES, LIMIT, RULE
from reports.multirate.words import KINDS, READING_NAMES, VEHICLE_SYSTEMS, VEHICLE_TITLES, VEHICLES
from reports.pages.pictures import Drawn, Narrowing
from sched_sim.processors.part import Part
from studies.multirate.accuracy import Reading
from studies.multirate.constancy import constant_from
from studies.multirate.patent import Load

LEAD_PERIODS = range(1, 11)
LIMIT_OF = "aircraft"


def drawn(
    results: Results, tended: Limits, own: Form, forms: Mapping[str, Form], patents: Part, cases: Sequence[Load]
) -> dict[str, Drawn]:
    """By file name, all but the schedules."""
    costs = least_time_of(own, patents)
    least = least_period(costs, LIMIT)
    assert least is not None
    of_each_second = {
        case.n: load.printed for case, load in zip(CASES, cases, strict=True) if case.rate_hz == Fraction(1)
    }
    ratios = {
        vehicle: {row.n: row.steady_mean for row in results.of(name, "averaged") if row.n in LEAD_PERIODS}
        for vehicle, name in VEHICLE_SYSTEMS.items()
    }
    return {
        "answer.svg": Narrowing(
            *(lead_figure(costs, of_each_second, least, ratios, narrow=narrow) for narrow in (False, True))
        ),
        "load.svg": _load(own, forms, patents, cases),
        "steady.svg": readings_figure(_readings(results), READING_NAMES),
        "rule.svg": rule_figure(_points(results), RULE),
        "gain.svg": gain_figure(
            {VEHICLE_TITLES[name]: results.gains[VEHICLE_SYSTEMS[name]] for name in VEHICLES},
            {VEHICLE_TITLES[name]: constant_from(results.changes[VEHICLE_SYSTEMS[name]]) for name in VEHICLES},
        ),
        "start.svg": start_figure(results.courses, results.starts),
        "limit.svg": limit_figure(tended.more[LIMIT_OF], tended.faster[LIMIT_OF]),
    }


def _load(own: Form, forms: Mapping[str, Form], patents: Part, cases: Sequence[Load]) -> Figure:
    """The forms whose loads lie on one another are the last two, U-D and square root."""
    names = {form.name: form.name for form in (own, *forms.values())}
    for form in forms.values():
        if time_of(form, patents) is None:
            names[form.name] = f"{form.name}, without its {form.square_roots} square roots"
    costs = {names[form.name]: least_time_of(form, patents) for form in (own, *forms.values())}
    printed = [
        Printed(case.n, load.printed, "" if case.rate_hz == 1 else f" in {1 / case.rate_hz} s")
        for case, load in zip(CASES, cases, strict=True)
    ]
    return load_figure(costs, 2, printed, PERIODS)


def _readings(results: Results) -> dict[str, dict[Reading, dict[int, float]]]:
    return {
        VEHICLE_TITLES[vehicle]: {
            reading: {row.n: row.steady_mean for row in results.of(VEHICLE_SYSTEMS[vehicle], reading)}
            for reading in READING_NAMES
        }
        for vehicle in VEHICLES
    }


def _points(results: Results) -> dict[str, list[Point]]:
    points: dict[str, list[Point]] = {kind: [] for kind in KINDS.values()}
    for name, share in results.shares.items():
        kind = next(kind for beginning, kind in KINDS.items() if name.startswith(beginning))
        points[kind] += [
            Point((row.n - 1) * share, row.steady_mean) for row in results.of(name, "averaged") if row.n > 1
        ]
    return points
