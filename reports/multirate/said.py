"""The numbers that the text of the report on the multirate gain says."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import ceil, floor
from typing import Any

from reports.multirate import limits, tables
from reports.multirate.costs import Form, every, least_period, least_time_of, patents_form, time_of
from reports.multirate.ratio_axis import LEAST
from reports.multirate.results import PERIODS, RECEIVER, SHOWN, N, Results
from reports.multirate.schedule import ONE_LOOP, one_loop_panel, two_rates_panel
from reports.multirate.words import VEHICLE_SYSTEMS, VEHICLES, change_text, ratio_text, scenario_text
from reports.pages.numbers import decimal, percent, significant
from sched_sim.costs.table import CostTable
from sched_sim.design.fit import fit
from sched_sim.design.load import utilization
from sched_sim.design.pieces import MultirateCosts
from sched_sim.processors.part import Part
from sched_sim.processors.part_file import load_part
from sched_sim.schedule.intervals import bars
from studies.multirate import patent
from studies.multirate.accuracy import GOOD, SPEEDS, Reading, largest_good
from studies.multirate.constancy import CONSTANT, constant_from

GANTT_HZ = Fraction(20)
CLOSE = ("U-D", "square-root")
"""Forms whose loads lie on that of the conventional short one."""


def saving(costs: MultirateCosts[Fraction], slow: patent.Load, aircraft: patent.Load) -> dict[str, Any]:
    """Loads by the patent's counts on its processor, at one measurement of all satellites a second."""
    each, multirate = (utilization(costs, every(n), Fraction(1)) for n in (1, N))
    least = least_period(costs, tables.LIMIT)
    if least is None or least == 1:
        raise ValueError("the patent's limit holds for no n, or for each, against the report's answer")
    below, at = (utilization(costs, every(n), Fraction(1)) for n in (least - 1, least))
    return {
        "each": percent(each),
        "printed": aircraft.printed,
        "printed_slow": slow.printed,
        "multirate": percent(multirate),
        "factor": decimal(each / multirate),
        "each_hz": f"{float(1 / each):.1f}",
        "multirate_hz": f"{float(1 / multirate):.1f}",
        "state_update_ms": f"{float(1000 * costs.state_update):.1f}",
        "covariance_gain_ms": f"{float(1000 * costs.covariance_gain):.1f}",
        "floor": percent(costs.state_update),
        "left": percent(multirate - costs.state_update),
        "limit": patent.LIMIT_PERCENT,
        "least_n": least,
        "at_least_n": percent(at),
        "below_least_n": percent(below),
    }


def answer(results: Results, costs: MultirateCosts[Fraction]) -> dict[str, Any]:
    """The n to take, the least within the patent's limit of load; and how many times the optimum the variance is then,
    by vehicle: good for the first alone."""
    n = least_period(costs, tables.LIMIT)
    if n is None:
        raise ValueError("no n is within the limit, against the report's answer")
    calm, *others = (results.at(VEHICLE_SYSTEMS[vehicle], "averaged", n).steady_mean for vehicle in VEHICLES)
    if not calm <= GOOD < min(others):
        raise ValueError("no n is within the limit and good for calm vehicles alone, against the report's answer")
    return {"n": n, "times": [significant(ratio) for ratio in (calm, *others)]}


def accuracy(results: Results) -> dict[str, Any]:
    """The receiver's at the patent's n, and how far the scalar rule holds."""
    receivers = [*VEHICLE_SYSTEMS.values()]

    def losses(reading: Reading) -> list[float]:
        return [results.at(name, reading, N).steady_mean for name in receivers]

    averaged, sampled, skipped = losses("averaged"), losses("sampled"), losses("skipped")
    good = {name: largest_good(results.of(name, "averaged")) for name in results.accuracies}
    slowest = f"random walk {SPEEDS[0]:g}"
    short_of_rule = [
        floor(tables.rule(share)) - good[name]
        for name, share in results.shares.items()
        if tables.rule(share) < max(PERIODS) + 1
    ]
    if min(short_of_rule) < 0:
        raise ValueError("a system is good for a larger n than the rule says, which the report calls its limit")
    return {
        "averaged": [ratio_text(ratio) for ratio in averaged],
        "sampled": [ratio_text(ratio) for ratio in sampled],
        "skipped": [ratio_text(ratio) for ratio in skipped],
        "good": [good[name] for name in receivers],
        "beaten": {vehicle: beaten_from(results, name) for vehicle, name in VEHICLE_SYSTEMS.items()},
        "good_ratio": f"{GOOD:g}",
        "good_percent": f"{100 * (GOOD - 1):g}",
        "good_sigma": f"{100 * (GOOD**0.5 - 1):.1f}",
        "rule": f"{tables.RULE:.2f}",
        "drawn_from": f"{100 * LEAST:g}",
        "short_of_rule": max(short_of_rule),
        "slow_limit": ratio_text((N**0.5 + N**-0.5) / 2),
        "slow_sampled": ratio_text(results.at(slowest, "sampled", N).steady_mean),
        "slow_averaged": f"{results.at(slowest, 'averaged', N).steady_mean:.4f}",
        "slowest": slowest,
        "both": _within_both(good),
    }


def beaten_from(results: Results, name: str) -> int | None:
    """The n from which on to skip measurements is better than to divide the gain, or None. ValueError: not for all n
    from there on."""
    skipped, averaged = ([row.steady_mean for row in results.of(name, reading)] for reading in ("skipped", "averaged"))
    better = [n for n, one, other in zip(PERIODS, skipped, averaged, strict=True) if one < other]
    if better and better != [*range(better[0], PERIODS[-1] + 1)]:
        raise ValueError(f"{name}: skipping is better for some n, and not from there on, as the report says")
    return better[0] if better else None


def _within_both(good: Mapping[str, int]) -> str:
    """The vehicles for which some n is within the patent's limit of load and good, in words."""
    least = least_period(least_time_of(patents_form(), load_part("patent")), tables.LIMIT)
    able = [vehicle for vehicle, name in VEHICLE_SYSTEMS.items() if least is not None and good[name] >= least]
    return f"{' and '.join(able)} only" if able else "none"


def constant(results: Results) -> dict[str, Any]:
    receivers = {name: VEHICLE_SYSTEMS[name] for name in VEHICLES}
    settled = max(tables.settled_change(results, name) for name in results.changes)
    if settled > CONSTANT:
        raise ValueError("a settled gain is not nearly constant, which the report says of all")
    return {
        "settled": significant(100 * settled, 2),
        "small": f"{100 * CONSTANT:g}",
        "first": [change_text(results.changes[name][0]) for name in receivers.values()],
        "at_10": [change_text(results.changes[name][10]) for name in receivers.values()],
        "from_step": [constant_from(results.changes[name]) for name in receivers.values()],
        "each": [f"{results.gains[name].optimal[-1]:.2f}" for name in receivers.values()],
        "divided": [f"{results.gains[name].divided[-1]:.2f}" for name in receivers.values()],
    }


def limit(found: limits.Limits, costs: MultirateCosts[Fraction]) -> dict[str, Any]:
    most, fastest = ({name: rows[-1] for name, rows in of.items()} for of in (found.more, found.faster))
    loads = {name: utilization(costs, every(N), 1 / hz) for name, hz in found.least_hz.items()}
    return {
        "between_s": limits.BETWEEN_S,
        "most": limits.MEASUREMENTS[-1],
        "fastest": limits.RATES_HZ[-1],
        "fine": [f"{most[name].optimal:.3f}" for name in VEHICLES],
        "fixed": [f"{most[name].averaged:.3f}" for name in VEHICLES],
        "fixed_ratio": [ratio_text(most[name].averaged_ratio) for name in VEHICLES],
        "fast": [f"{fastest[name].averaged:.3f}" for name in VEHICLES],
        "fast_above": f"{ceil(1e4 * max(fastest[name].averaged_ratio - 1 for name in VEHICLES)) / 100:g}",
        "fast_sampled": [f"{fastest[name].sampled:.3f}" for name in VEHICLES],
        "fast_sampled_ratio": [ratio_text(fastest[name].sampled_ratio) for name in VEHICLES],
        "least_hz": [f"{float(hz):g}" for hz in found.least_hz.values()],
        "between_good_s": [f"{float(N / hz):.1f}" for hz in found.least_hz.values()],
        "load_there": [significant(100 * load) for load in loads.values()],
        "still": ratio_text(next(row for row in found.faster[VEHICLES[-1]] if row.period_s == 1).averaged_ratio),
    }


def forms(own: Form, ours: Mapping[str, Form], patents: Part) -> dict[str, Any]:
    """From which n on each form keeps to the patent's limit, and by how much the two last are at most above the short
    one, in percent."""
    costs = {form.name: least_time_of(form, patents) for form in (own, *ours.values())}
    least = sorted({n for n in (least_period(of, tables.LIMIT) for of in costs.values()) if n is not None})
    loads = {name: [utilization(of, every(n), Fraction(1)) for n in PERIODS] for name, of in costs.items()}
    short = loads["conventional, short"]
    above = [one / other - 1 for name in CLOSE for one, other in zip(loads[name], short, strict=True)]
    return {"least_n": " or ".join(map(str, least)), "closest": f"{ceil(1000 * max(above)) / 10:g}"}


def start(results: Results) -> dict[str, Any]:
    soon = results.at(RECEIVER, "averaged", N)
    remedied = results.starts[N]
    return {
        "worst": ratio_text(soon.worst),
        "settled": soon.settled_step,
        "steady": ratio_text(soon.steady_worst),
        "after": {steps: ratio_text(remedied[steps]) for steps in (10, 20, 30)},
        "peaks": [
            (n, ratio_text(results.at(RECEIVER, "averaged", n).worst), results.at(RECEIVER, "averaged", n).worst_step)
            for n in SHOWN
        ],
        "change": f"{ceil(10_000 * _largest_change(results)) / 100:g}",
        "worse": _worse_if_late(results),
    }


def _largest_change(results: Results) -> float:
    """By how much the steady ratio of any scenario changes at most if the gain comes n steps late."""
    pairs = [
        (results.at(name, "averaged", N), results.at(name, "averaged", N, late=True)) for name in results.accuracies
    ]
    return max(abs(later.steady_mean / soon.steady_mean - 1) for soon, later in pairs)


def _worse_if_late(results: Results) -> list[tuple[str, str, str]]:
    """Systems whose worst ratio is more than 5 % higher if the gain comes n steps late, with both ratios."""
    pairs = {
        name: [results.at(name, "averaged", N, late=late).worst for late in (False, True)]
        for name in results.accuracies
    }
    return [
        (scenario_text(name), ratio_text(soon), ratio_text(later))
        for name, (soon, later) in pairs.items()
        if later > 1.05 * soon
    ]


def running(form: Form, parts: list[Part]) -> dict[str, Any]:
    """The conventional form at the rate and n of the processor table."""
    verdicts = {part.name: fit(least_time_of(form, part), every(N), Fraction(tables.RATE_HZ)) for part in parts}
    hz = {name: tables.RATE_HZ / verdict.needed for name, verdict in verdicts.items()}
    able = [name for name, verdict in verdicts.items() if verdict.fits]
    slowest, fastest = min(able, key=hz.__getitem__), max(able, key=hz.__getitem__)
    return {
        "rate": tables.RATE_HZ,
        "all": len(parts),
        "able": len(able),
        "busiest_load": f"{100 * float(max(verdicts[name].load for name in able)):.0f}",
        "slowest": (slowest, significant(hz[slowest])),
        "fastest": (fastest, significant(hz[fastest])),
        "unable": [(name, significant(rate)) for name, rate in hz.items() if name not in able],
    }


def missing(forms: Mapping[str, Form], parts: list[Part], patents: Part) -> dict[str, Any]:
    """Square roots, who has no time for them, and how long one may take on the patent's processor so that the n within
    its limit stay what they are without any, in ms and in divisions."""
    asking = [form for form in forms.values() if form.square_roots]
    without = [part.name for part in parts if any(time_of(form, part) is None for form in asking)]
    longest = min(_longest_square_root(form, patents) for form in asking)
    return {
        "forms": [(form.name, form.square_roots) for form in asking],
        "processors": without,
        "longest_ms": f"{floor(10_000 * longest) / 10:g}",
        "longest_divisions": floor(longest / patents.seconds["divide"]),
    }


def _longest_square_root(form: Form, part: Part) -> Fraction:
    """In seconds; all of a form are in its covariance and gain."""
    costs = least_time_of(form, part)
    n = least_period(costs, tables.LIMIT)
    if n is None:
        raise ValueError(f"{form.name} is within the patent's limit for no n, which the report says of none")
    return (n * (tables.LIMIT - costs.state_update) - costs.covariance_gain) / form.square_roots


def gantt(table: CostTable) -> dict[str, Any]:
    loop, rates = (panel(table, N, GANTT_HZ).schedule for panel in (one_loop_panel, two_rates_panel))
    if rates.misses or not loop.misses:
        raise ValueError("one loop misses no deadline, or two rates do, against what the report says")
    (landed,) = rates.achieved
    busy = f"{100 * float(rates.utilization):.0f}"
    late = sum(bar.style == ONE_LOOP["P"] and bar.overdue is not None for bar in bars(loop))
    return {"hz": f"{float(GANTT_HZ):g}", "landed": landed, "busy": busy, "late": late}
