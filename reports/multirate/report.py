"""The report on the multirate gain of the patent "Optimal covariance filtering": what it saves and what it costs."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import ceil, floor
from typing import Any

from reports.multirate import tables
from reports.multirate.accuracy import Curve, Family, start_figure, steady_figure
from reports.multirate.costs import Form, every, least_time_of, our_forms, patents_form, time_of
from reports.multirate.figures import load_figure, one_loop_panel, two_rates_panel
from reports.multirate.results import PERIODS, RECEIVER, SHOWN, Results
from reports.multirate.words import ratio_text, scenario_text
from reports.pages.numbers import decimal, percent, significant
from reports.pages.pictures import files, pictures
from reports.pages.render import csv_bytes, render
from sched_sim.design.fit import fit
from sched_sim.design.load import utilization
from sched_sim.processors.part import Part, on_part
from sched_sim.processors.part_file import load_part, shipped_parts
from studies.multirate import patent
from studies.multirate.accuracy import ACCELERATION_NOISES, GOOD, SPEEDS, TRACKING_INDICES, Reading, largest_good

TITLE = "The multirate gain, regenerated: what it saves, and what it costs"
GANTT_HZ = Fraction(20)
WALKS = (SPEEDS[0], *SPEEDS[2:5])
"""The figure's; the others are in the table."""

READING_NAMES: Mapping[Reading, str] = {
    "averaged": "$K(R/n)/n$",
    "sampled": "$K(R)/n$",
    "skipped": "every $n$-th measurement",
}


def build(results: Results) -> dict[str, bytes]:
    """All files of the report by name, as a pure function of what the studies found."""
    own, forms = patents_form(), our_forms()
    parts = [load_part(name) for name in shipped_parts()]
    patents = next(part for part in parts if part.name == "patent")
    cases, N = patent.loads(), tables.N
    textbook = forms["conventional, textbook"]
    asked = [(textbook, 1), (textbook, N), (forms["U-D"], N), (forms["square-root"], N)]
    rows = {
        "loads": tables.loads(cases),
        "our-loads": tables.our_loads(forms.values(), patents),
        "logic": tables.logic(own, textbook, parts),
        "terms": tables.term_rows(),
        "totals": tables.totals(),
        "load-by-n": tables.load_by_n([own, *forms.values()], patents, PERIODS),
        "steady": tables.steady(results),
        "late": tables.late(results),
        "starts": tables.starts(results),
        "processors": tables.processor_rows(asked, parts),
    }
    on_patents = on_part(own.table, patents)
    figures = pictures(
        {
            "load.svg": _load_figure([own, *forms.values()], patents, cases),
            "steady.svg": steady_figure(_families(results), READING_NAMES),
            "start.svg": start_figure(results.courses, results.starts),
            "rates.svg": [one_loop_panel(on_patents, N, GANTT_HZ), two_rates_panel(on_patents, N, GANTT_HZ)],
        }
    )
    pages = render(
        "patent-multirate",
        TITLE,
        figures,
        **{name.replace("-", "_"): table for name, table in rows.items()},
        N=N,
        saving=_saving(own, patents, cases[1]),
        accuracy=_accuracy(results),
        start=_start(results),
        running=_running(textbook, parts),
        missing=_missing(forms, parts),
        remainders={cycle: patent.comparison(cycle).remainder for cycle in patent.CYCLES},
        observations=[observation.text for observation in patent.observations() if observation.holds],
        gantt=_gantt(on_patents),
        logic_factors=[row[1] for row in rows["logic"][1:3]],
    )
    return {
        **pages,
        **files(figures),
        **{f"{name}.csv": csv_bytes(table) for name, table in rows.items()},
        "accuracy.csv": csv_bytes(tables.accuracy_rows(results)),
    }


def _saving(own: Form, patents: Part, aircraft: patent.Load) -> dict[str, str]:
    """Loads by the patent's counts on its processor, at one measurement of all satellites a second."""
    costs = least_time_of(own, patents)
    each, multirate = (utilization(costs, every(n), Fraction(1)) for n in (1, tables.N))
    return {
        "each": percent(each),
        "printed": aircraft.printed,
        "multirate": percent(multirate),
        "factor": decimal(each / multirate),
        "each_hz": f"{float(1 / each):.1f}",
        "multirate_hz": f"{float(1 / multirate):.1f}",
        "state_update_ms": f"{float(1000 * costs.state_update):.1f}",
        "covariance_gain_ms": f"{float(1000 * costs.covariance_gain):.1f}",
        "floor": percent(costs.state_update),
    }


def _accuracy(results: Results) -> dict[str, Any]:
    """The receiver's at the patent's n, and how far the scalar rule holds."""
    receivers = [f"gps {noise:g}" for noise in ACCELERATION_NOISES]

    def losses(reading: Reading) -> list[float]:
        return [results.at(name, reading, tables.N).steady_mean for name in receivers]

    averaged, sampled, skipped = losses("averaged"), losses("sampled"), losses("skipped")
    good = {name: largest_good(results.of(name, "averaged")) for name in results.accuracies}
    aircraft, slowest = receivers[-1], f"random walk {SPEEDS[0]:g}"
    beaten = [
        n
        for n in PERIODS
        if n > 1 and results.at(aircraft, "skipped", n).steady_mean < results.at(aircraft, "averaged", n).steady_mean
    ]
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
        "sigma": [ratio_text(ratio**0.5) for ratio in averaged],
        "good": [good[name] for name in receivers],
        "share": [f"{results.shares[name]:.2f}" for name in receivers],
        "beaten": beaten[0] if beaten else None,
        "limit": f"{GOOD:g}",
        "short_of_rule": max(short_of_rule),
        "slow_limit": ratio_text((tables.N**0.5 + tables.N**-0.5) / 2),
        "slow_sampled": ratio_text(results.at(slowest, "sampled", tables.N).steady_mean),
        "slow_averaged": f"{results.at(slowest, 'averaged', tables.N).steady_mean:.4f}",
        "slowest": slowest,
    }


def _start(results: Results) -> dict[str, Any]:
    soon = results.at(RECEIVER, "averaged", tables.N)
    later = results.at(RECEIVER, "averaged", tables.N, late=True)
    remedied = results.starts[tables.N]
    return {
        "worst": ratio_text(soon.worst),
        "step": soon.worst_step,
        "settled": soon.settled_step,
        "late_settled": later.settled_step,
        "late_worst": ratio_text(later.worst),
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
        (results.at(name, "averaged", tables.N), results.at(name, "averaged", tables.N, late=True))
        for name in results.accuracies
    ]
    return max(abs(later.steady_mean / soon.steady_mean - 1) for soon, later in pairs)


def _worse_if_late(results: Results) -> list[tuple[str, str, str]]:
    """Systems whose worst ratio is more than 5 % higher if the gain comes n steps late, with both ratios."""
    pairs = {
        name: [results.at(name, "averaged", tables.N, late=late).worst for late in (False, True)]
        for name in results.accuracies
    }
    return [
        (scenario_text(name), ratio_text(soon), ratio_text(later))
        for name, (soon, later) in pairs.items()
        if later > 1.05 * soon
    ]


def _running(form: Form, parts: list[Part]) -> dict[str, Any]:
    """The conventional form at the rate and n of the processor table."""
    verdicts = {part.name: fit(least_time_of(form, part), every(tables.N), Fraction(tables.RATE_HZ)) for part in parts}
    hz = {name: tables.RATE_HZ / verdict.needed for name, verdict in verdicts.items()}
    able = [name for name, verdict in verdicts.items() if verdict.fits]
    slowest, fastest = min(able, key=hz.__getitem__), max(able, key=hz.__getitem__)
    return {
        "rate": tables.RATE_HZ,
        "all": len(parts),
        "able": len(able),
        "busiest_load": percent(max(verdicts[name].load for name in able)),
        "slowest": (slowest, significant(hz[slowest])),
        "no_sqrt": tables.NO_SQRT,
        "fastest": (fastest, significant(hz[fastest])),
        "unable": [(name, significant(rate)) for name, rate in hz.items() if name not in able],
    }


def _missing(forms: Mapping[str, Form], parts: list[Part]) -> dict[str, Any]:
    """Square roots, and who has no time for them."""
    asking = [form for form in forms.values() if form.square_roots]
    without = [part.name for part in parts if any(time_of(form, part) is None for form in asking)]
    return {"forms": [(form.name, form.square_roots) for form in asking], "processors": without}


def _gantt(table: Any) -> dict[str, Any]:
    schedule = two_rates_panel(table, tables.N, GANTT_HZ).schedule
    (landed,) = schedule.achieved
    return {"hz": f"{float(GANTT_HZ):g}", "landed": landed, "busy": percent(schedule.utilization)}


def _load_figure(forms: list[Form], patents: Part, cases: list[patent.Load]) -> Any:
    names = {form.name: form.name for form in forms}
    for form in forms:
        if time_of(form, patents) is None:
            names[form.name] = f"{form.name}, without its {form.square_roots} square roots"
    printed: dict[int, list[str]] = {}
    for case, of_patent in zip(tables.CASES, cases, strict=True):
        if case.rate_hz == 1:
            printed.setdefault(case.n, []).append(of_patent.printed)
    return load_figure({names[form.name]: least_time_of(form, patents) for form in forms}, printed, PERIODS)


def _families(results: Results) -> list[Family]:
    columns = {
        "Random walk, by $q\\,\\Delta T/R$": {f"{speed:g}": f"random walk {speed:g}" for speed in WALKS},
        "Tracker, by $\\sqrt{q\\,\\Delta T^3/R}$": {f"{index:g}": f"tracker {index:g}" for index in TRACKING_INDICES},
        "Receiver, by m/s²/√Hz": {f"{noise:g}": f"gps {noise:g}" for noise in ACCELERATION_NOISES},
    }
    return [
        Family(
            title,
            {
                reading: [
                    Curve(label, {row.n: row.steady_mean for row in results.of(name, reading)})
                    for label, name in labels.items()
                ]
                for reading in READING_NAMES
            },
        )
        for title, labels in columns.items()
    ]
