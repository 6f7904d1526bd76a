"""The tables of the report on the multirate gain; the first row of each is its heading."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from math import sqrt
from typing import Any, NamedTuple

from filters.arrays import FloatArray
from reports.multirate.costs import Form, every, least_period, least_time_of, time_of
from reports.multirate.results import RECEIVER, SHOWN, N, Results
from reports.multirate.words import change_text, ratio_text, reading_text, scenario_text
from reports.pages.numbers import decimal, percent, significant
from sched_sim.costs.operations import arithmetic
from sched_sim.design.fit import fit
from sched_sim.design.load import utilization
from sched_sim.processors.part import Part
from studies.multirate.accuracy import GOOD, Accuracy, Reading, largest_good
from studies.multirate.constancy import CONSTANT, constant_from
from studies.multirate.patent import CYCLES, LIMIT_PERCENT, Load, comparison, terms

Rows = list[list[Any]]


class Case(NamedTuple):
    """One of the patent's three cases: n, and state updates per second."""

    name: str
    n: int
    rate_hz: Fraction


CASES = (
    Case("trucks, tanks: a cycle in 4 s", 1, Fraction(1, 4)),
    Case("aircraft: a cycle each second", 1, Fraction(1)),
    Case("multirate: a gain every 5 s", 5, Fraction(1)),
)
"""In the patent's order."""

CYCLE_NAMES = {"state_update": "state update", "covariance_gain": "covariance and gain"}

OTHERS: tuple[Reading, ...] = ("sampled", "skipped")

NO_SQRT = "no sqrt"

RATE_HZ = 100
"""Of the table of processors."""
LIMIT = Fraction(LIMIT_PERCENT, 100)
CHANGED_FROM = (0, 10, 50)
"""Steps from which changes of a gain are told."""
LAST_STEPS = 50
"""Of a run: settled."""


def loads(printed: Sequence[Load]) -> Rows:
    """Printed, as the patent computes it, and complete; in percent of its processor."""
    rows: Rows = [["Case", "printed, %", "computed, %", "with state update, %"]]
    for case, load_of in zip(CASES, printed, strict=True):
        exact = [percent(share / 100) for share in (load_of.percent, load_of.complete_percent)]
        rows.append([case.name, load_of.printed, *exact])
    return rows


def our_loads(forms: Iterable[Form], processor: Part) -> Rows:
    """The same cases with our forms on the patent's processor, state update included; in percent."""
    forms = list(forms)
    rows: Rows = [["Case", *(_bounded(form, processor) for form in forms)]]
    for case in CASES:
        shares = [utilization(least_time_of(form, processor), every(case.n), 1 / case.rate_hz) for form in forms]
        rows.append([case.name, *(percent(share) for share in shares)])
    return rows


def _bounded(form: Form, processor: Part) -> str:
    """The form's name; its loads are lower bounds where the processor has no time for its square roots."""
    return form.name if time_of(form, processor) else f"≥ {form.name}"


def logic(own: Form, ours: Form, processors: Sequence[Part]) -> Rows:
    """How much of the covariance-and-gain job is logic. own: the patent's counts; ours: for the processors."""
    rows: Rows = [["Source", "logic per arithmetic operation", "share of its time, %"]]
    (patents,) = [processor for processor in processors if processor.name == "patent"]
    for kind, name in CYCLE_NAMES.items():
        counts = own.table.operations[own.method][kind]
        time = getattr(least_time_of(own, patents), kind)
        share = counts["logic"] * patents.seconds["logic"] / time
        factor = Fraction(counts["logic"], arithmetic(counts))
        rows.append([f"the patent, {name}: {counts['logic']} / {arithmetic(counts)}", decimal(factor), percent(share)])
    for processor in processors:
        if processor is not patents:
            factor = processor.logic_per_arithmetic
            counts = ours.table.operations[ours.method]["covariance_gain"]
            work = factor * arithmetic(counts) * processor.seconds["logic"]
            share = work / least_time_of(ours, processor).covariance_gain
            rows.append([processor.name, decimal(factor), percent(share)])
    return rows


def term_rows() -> Rows:
    """Our loops, term by term."""
    rows: Rows = [["Cycle", "Term", "multiply", "add", "add, sums from zero", "divide", "in our job"]]
    for term in terms():
        ours = term.ours
        counts = [ours.multiply, ours.add, term.from_zero.add, ours.divide]
        rows.append([CYCLE_NAMES[term.cycle], term.name, *counts, "yes" if term.in_job else "no"])
    return rows


def totals() -> Rows:
    """Our sums beside the patent's."""
    rows: Rows = [["Cycle", "Sum", "multiply", "add", "divide"]]
    for cycle in CYCLES:
        compared = comparison(cycle)
        sums = {"our job": compared.job, "with noise model": compared.with_noise_model}
        if compared.job == compared.with_noise_model:
            del sums["with noise model"]
        sums |= {"sums from zero": compared.from_zero, "printed": compared.printed}
        for name, counts in sums.items():
            rows.append([CYCLE_NAMES[cycle], name, counts.multiply, counts.add, counts.divide])
        remainder = [compared.remainder[kind] for kind in ("multiply", "add", "divide")]
        rows.append([CYCLE_NAMES[cycle], "printed less the above", *(f"{number:+d}" for number in remainder)])
    return rows


def limit_by_form(forms: Iterable[Form], processor: Part) -> Rows:
    """The least n of each form that keeps to the patent's limit at one measurement a second, and the load there."""
    rows: Rows = [["Counts and form", "load at n = 1, %", f"within {LIMIT_PERCENT} % from", "load there, %"]]
    for form in forms:
        costs = least_time_of(form, processor)
        n = least_period(costs, LIMIT)
        there = "-" if n is None else percent(utilization(costs, every(n), Fraction(1)))
        alone = percent(utilization(costs, every(1), Fraction(1)))
        rows.append([_bounded(form, processor), alone, "no n" if n is None else f"n = {n}", there])
    return rows


def load_by_n(forms: Iterable[Form], processor: Part, periods: Iterable[int]) -> Rows:
    """The load at one measurement (of all satellites) a second, in percent."""
    forms = list(forms)
    rows: Rows = [["n", *(_bounded(form, processor) for form in forms)]]
    for n in periods:
        shares = [utilization(least_time_of(form, processor), every(n), Fraction(1)) for form in forms]
        rows.append([n, *(percent(share) for share in shares)])
    return rows


def steady(results: Results) -> Rows:
    """The ratio in steady state of every scenario, the share K, and up to which n it is good."""
    rows: Rows = [
        [
            "System",
            "K",
            *(f"n = {n}" for n in SHOWN),
            "good to n",
            "rule",
            f"R, n = {N}",
            f"skipped, n = {N}",
        ]
    ]
    for name in results.accuracies:
        averaged = [ratio_text(results.at(name, "averaged", n).steady_mean) for n in SHOWN]
        sampled, skipped = (ratio_text(results.at(name, reading, N).steady_mean) for reading in OTHERS)
        share = results.shares[name]
        row = [scenario_text(name), f"{share:.3f}", *averaged, largest_good(results.of(name, "averaged"))]
        rows.append([*row, f"{rule(share):.1f}", sampled, skipped])
    return rows


RULE = sqrt(8 * (GOOD - 1))
"""The (n - 1) K at which 1 + ((n - 1) K)^2 / 8, the ratio of a slow scalar filter, becomes GOOD."""


def rule(share: float) -> float:
    """The n of RULE."""
    return 1 + RULE / share


def constancy(results: Results) -> Rows:
    """By how much of itself the optimal gain of every scenario changes in N steps, in percent."""
    heads = [*(f"from step {step}" for step in CHANGED_FROM), "settled"]
    rows: Rows = [["System", "K", *heads, f"below {100 * CONSTANT:g} % from step"]]
    for name, changes in results.changes.items():
        told = [*(changes[step] for step in CHANGED_FROM), settled_change(results, name)]
        row = [scenario_text(name), f"{results.shares[name]:.3f}", *map(change_text, told)]
        rows.append([*row, constant_from(changes)])
    return rows


def settled_change(results: Results, name: str) -> float:
    return float(results.changes[name][-LAST_STEPS:].max())


def late(results: Results) -> Rows:
    """At the patent's n: the gain in use at once and n steps later; steady, and the worst after the start."""
    rows: Rows = [["System"]]
    for head in ("steady", "peak", "step", "settled"):
        rows[0] += [head, f"{head} late"]
    for name in results.accuracies:
        soon, later = (results.at(name, "averaged", N, late=late) for late in (False, True))
        row: list[Any] = [scenario_text(name)]
        row += [ratio_text(accuracy.steady_mean) for accuracy in (soon, later)]
        row += [ratio_text(accuracy.worst) for accuracy in (soon, later)]
        rows.append([*row, peak_step(soon), peak_step(later), soon.settled_step, later.settled_step])
    return rows


def peak_step(row: Accuracy) -> int | str:
    """None ("-") if there is no peak: then some step of the steady state has the largest ratio, by its last digit."""
    return row.worst_step if row.worst > row.steady_worst * (1 + 1e-6) else "-"


def starts(results: Results) -> Rows:
    """The worst ratio of the receiver's run by the number of steps at full rate."""
    rows: Rows = [["Steps with a gain each", *(f"n = {n}" for n in SHOWN)]]
    for steps in results.starts[SHOWN[0]]:
        rows.append([steps, *(ratio_text(results.starts[n][steps]) for n in SHOWN)])
    steady_worst = [ratio_text(results.at(RECEIVER, "averaged", n).steady_worst) for n in SHOWN]
    return [*rows, ["steady state", *steady_worst]]


def processor_rows(forms: Sequence[tuple[Form, int]], processors: Sequence[Part]) -> Rows:
    """forms: with the n of each."""
    heads = ("needs, MHz", "load, %", "slack, %", "highest, Hz")
    rows: Rows = [["Processor", "MHz", "precision", "Filter", "n", "runs", *heads]]
    for part in processors:
        clock = "-" if part.clock_hz is None else f"{float(part.clock_hz / 10**6):g}"
        for form, n in forms:
            row: list[Any] = [part.name, clock, part.precision, form.name.removesuffix(", textbook"), n]
            costs = time_of(form, part)
            if costs is None:
                rows.append([*row, NO_SQRT, "-", "-", "-", "-"])
                continue
            verdict = fit(costs, every(n), Fraction(RATE_HZ))
            needed = "-" if part.clock_hz is None else significant(verdict.needed * part.clock_hz / 10**6)
            row += ["yes" if verdict.fits else "no", needed, percent(verdict.load), percent(verdict.slack)]
            rows.append([*row, significant(RATE_HZ / verdict.needed)])
    return rows


def accuracy_rows(results: Results) -> Rows:
    """Everything the study found, for a spreadsheet."""
    heads = ["system", "filter", "n", "L", "steady_mean", "steady_worst", "worst", "worst_step", "settled_step"]
    return [
        heads,
        *(
            [scenario_text(row.scenario), reading_text(row.reading), row.n, row.L]
            + [f"{value:.6g}" for value in (row.steady_mean, row.steady_worst, row.worst)]
            + [peak_step(row), row.settled_step]
            for rows in results.accuracies.values()
            for row in rows
        ),
    ]


def gain_rows(results: Results) -> Rows:
    """The share of an innovation that each receiver believes in every step."""
    columns = {
        f"{scenario_text(name)}, {which}": getattr(course, which)
        for name, course in results.gains.items()
        for which in course._fields
    }
    return _by_step(columns)


def course_rows(results: Results) -> Rows:
    """The ratio of RECEIVER in every step, by n."""
    return _by_step({f"n = {n}": course for n, course in results.courses.items()})


def _by_step(columns: Mapping[str, FloatArray]) -> Rows:
    steps = len(next(iter(columns.values())))
    return [["step", *columns], *([k, *(f"{values[k]:.5g}" for values in columns.values())] for k in range(steps))]
