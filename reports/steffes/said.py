"""What the prose of the report says in numbers: each from the tables and figures it speaks of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from reports.charts.panels import METHOD_NAMES
from reports.pages.machine import residue
from reports.pages.measurements import counted_on
from reports.pages.numbers import power, significant
from reports.steffes.processors import SWITCHES, Variant
from reports.steffes.rows import BY_L, CYCLES, SMALL_DELAYS, at_p95, least, number, over, span
from reports.steffes.timelines import serial_costs
from reports.steffes.waiting import Waited, by_wait, off_the_curve
from sched_sim.costs.table import CostTable
from sched_sim.design.least_speed import achieved_l, least_speed
from sched_sim.design.load import utilization
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts, RecalculateCosts, StandardCosts
from sched_sim.design.timing import Timing
from studies.machines.ranges import range_of
from studies.steffes import tables as steffes
from studies.steffes.agreement import FLOOR, Agreement
from studies.steffes.equations import EQUATIONS
from studies.steffes.memory import Memory
from studies.steffes.noise import Approximated, tried
from studies.steffes.noise_long import CYCLES as MANY_CYCLES
from studies.steffes.noise_long import worst
from studies.steffes.products import Multiplies

FIGURE_3 = Timing(10, 4, 8)
WASTE = Timing(100, 10, 80)
ONE_HUNDREDTH = Fraction(1, 100)


def percent(share: Fraction | float, digits: int = 0) -> str:
    return f"{100 * float(share):.{digits}f} %"


def about_tables(
    tables: Mapping[str, CostTable], measured: Sequence[CostTable], cells: Sequence[steffes.Cell]
) -> dict[str, Any]:
    """Of Tables 1 to 4; measured: each normalised."""
    speeds = {
        method: {name: least(tables[name], method, FIGURE_3) for name in ("printed", "counted")}
        for method in ("larsen", "dual-rate")
    }
    below = [1 - cell.printed / cell.computed.speed for cell in cells if not cell.reached]
    share = speeds["dual-rate"]["printed"] / speeds["larsen"]["printed"]
    return {
        "cells": len(cells),
        "reached": sum(cell.reached for cell in cells),
        "counted_deviation": f"{steffes.deviation(tables['counted']):.3f}",
        "measured_deviation": span(*range_of(steffes.deviation, measured)),
        **{
            method: {
                **{name: number(speed) for name, speed in of.items()},
                "measured": span(*over(measured, method, FIGURE_3)),
                "p95": number(at_p95(measured, method, FIGURE_3)),
            }
            for method, of in speeds.items()
        },
        "measurements": counted_on(measured),
        "here": [number(speeds[method]["printed"], 2) for method in ("dual-rate", "larsen")],
        "recalculate": number(least(tables["printed"], "recalculate", FIGURE_3), 2),
        "share": percent(share),
        "later": FIGURE_3.L - FIGURE_3.M,
        "design": FIGURE_3,
        "busy": [
            percent(utilization(select(tables["printed"], method), FIGURE_3, of["printed"]))
            for method, of in speeds.items()
        ],
        "below": [f"{100 * float(share):.0f}" for share in (min(below), max(below))],
        "cycles": CYCLES,
    }


def not_reached(paper: CostTable, cells: Sequence[steffes.Cell]) -> list[str]:
    """One text for each printed figure that the rounding of Tables 1-3 cannot give."""
    texts: dict[tuple[str, Fraction], str] = {}
    for cell in cells:
        if not cell.reached:
            N, M, L = cell.timing.N, cell.timing.M, cell.timing.L
            texts.setdefault(
                (cell.method, cell.printed),
                f"**{number(cell.printed, 2)}** ({METHOD_NAMES[cell.method]}, N = {N}, M = {M}"
                + (f", L = {L}" if cell.method == "dual-rate" else ", printed for both values of L")
                + f"), where the analysis gives {number(cell.computed.speed, 2)}. {_why(paper, cell)}",
            )
    return list(texts.values())


def _why(paper: CostTable, cell: steffes.Cell) -> str:
    costs = select(paper, cell.method)
    if isinstance(costs, RecalculateCosts):
        (entry,) = [one for one in steffes.entries() if (one.table, one.step, one.column) == (1, "m", "update")]
        of, M, speed = FIGURE_3.M, cell.timing.M, cell.computed.speed
        first, fixed, step = (number(cost, 2) for cost in (costs.propagate, costs.update, costs.replay))
        return (
            f"Table 1 prints {number(entry.printed, 2)} for the update at M = {of}, which is {fixed} and {of} replayed "
            f"steps of {step}; {M} of them make {first} + {fixed} + {M} × {step} = {number(speed, 2)}. The printed "
            f"figure lies {percent(1 - cell.printed / speed)} below what its own Table 1 extrapolates to."
        )
    assert isinstance(costs, DualRateCosts)
    hr, update, correct = (number(cost, 2) for cost in (costs.hr, costs.lr_update, costs.hr_update))
    return (
        f"The printed figure is HR propagate + LR update / (L − M) = {hr} + {update} / "
        f"{cell.timing.L - cell.timing.M}. But step l also runs the HR update: it alone needs {hr} + {correct} = "
        f"{number(costs.hr + costs.hr_update, 2)}."
    )


def about_serial(paper: CostTable) -> dict[str, Any]:
    """Of Fig. 1."""
    costs = serial_costs(paper)
    speed = least_speed(costs, FIGURE_3).speed
    return {
        "N": FIGURE_3.N,
        "propagate": number(costs.propagate, 2),
        "update": number(costs.update, 2),
        "speed": number(speed, 2),
        "unused": percent(1 - utilization(costs, FIGURE_3, speed)),
    }


def about_waiting(paper: CostTable, found: Sequence[Waited]) -> dict[str, Any]:
    """Of least speed against L - M."""
    costs = select(paper, "dual-rate")
    assert isinstance(costs, DualRateCosts)
    off = list(off_the_curve(found, paper))
    floor = costs.hr + costs.hr_update
    last = least(paper, "dual-rate", WASTE)
    return {
        "designs": len(found),
        "on": len(found) - len(off),
        "off": len(off),
        "off_M": ", ".join(map(str, sorted({one.timing.M for one in off}))),
        "off_speed": number(max(one.speed for one in off), 2),
        "floor": number(floor, 2),
        "one": number(by_wait(costs, 1), 2),
        "enough": next(steps for steps in range(1, WASTE.N) if by_wait(costs, steps) == floor),
        "waste": {
            "N": WASTE.N,
            "M": WASTE.M,
            "L": WASTE.L,
            "speed": number(last),
            "achieved": achieved_l(costs, WASTE, last),
        },
    }


def about_agreement(found: Agreement) -> dict[str, Any]:
    low, high = found.while_waiting
    return {
        "state": power(residue(found.elsewhere)),
        "covariance": power(residue(found.of_covariance)),
        "floor": power(residue(FLOOR)),
        "low": percent(low),
        "high": percent(high),
        "steps": len(found.waiting) - 1,
    }


def about_products(counted: Sequence[Multiplies], memory: Sequence[Memory]) -> dict[str, Any]:
    exact, summed, larsen = (
        ("dual-rate", "hr_propagate"),
        ("dual-rate", "hr_propagate_sum"),
        ("larsen", "propagate_accumulate"),
    )
    assert all(one.more(exact) == one.more(larsen) == -one.more(summed) == one.n**3 for one in counted)
    of = {one.method: one for one in memory}
    nine = next(one for one in counted if one.n == 9)
    return {
        "sizes": ", ".join(str(one.n) for one in counted),
        "more": nine.more(exact),
        "saved": f"{nine.by_job[exact] - nine.by_job[summed]:,}",
        "of": f"{nine.by_job[exact]:,}",
        "memory": f"{of['dual-rate'].total / of['larsen'].total:.2f}",
        "larsen": f"{of['larsen'].total:,}",
        "dual": f"{of['dual-rate'].total:,}",
        "larsen_kept": of["larsen"].matrices,
        "dual_kept": of["dual-rate"].matrices,
    }


def about_work(tables: Mapping[str, CostTable]) -> dict[str, Any]:
    """Of all the work of a cycle, in standard steps, by the standard filter, Larsen's method and the dual-rate filter;
    and what the last takes more than the first for updates."""
    by_source = {
        source: [
            FIGURE_3.N * utilization(select(tables[source], method), FIGURE_3, Fraction(1))
            for method in ("standard", "larsen", "dual-rate")
        ]
        for source in ("printed", "counted")
    }
    standard, dual = (select(tables["counted"], method) for method in ("standard", "dual-rate"))
    assert isinstance(standard, StandardCosts)
    assert isinstance(dual, DualRateCosts)
    return {
        **{source: [number(work, 2) for work in works] for source, works in by_source.items()},
        "over_larsen": {source: percent(last / larsen - 1) for source, (_, larsen, last) in by_source.items()},
        "more_update": number(dual.lr_update + dual.hr_update - standard.update, 2),
    }


def about_processors(
    found: Sequence[Variant],
    landed: Mapping[str, Sequence[tuple[float, int]]],
    speeds: Mapping[str, Sequence[Fraction]],
) -> dict[str, Any]:
    """Of one CPU or two, the gain computed early, and of switches. landed: from `landings`."""
    by_name = {one.name: one for one in found}
    one, two, early = by_name["one CPU"], by_name["two CPUs"], by_name["one CPU, early gain"]
    at = SWITCHES.index(ONE_HUNDREDTH)
    rises = {method: (of[at] - of[0]) / ONE_HUNDREDTH for method, of in speeds.items()}
    even = (speeds["larsen"][0] - speeds["dual-rate"][0]) / (rises["dual-rate"] - rises["larsen"])
    return {
        "one": number(one.speed),
        "two": number(two.speed),
        "early": number(early.speed),
        "late": number(next(speed for speed, L in landed["one CPU"] if two.lands == L), 2),
        "lands": {"one": one.lands, "two": two.lands, "early": early.lands},
        "two_saves": percent(1 - two.speed / one.speed),
        "early_saves": percent(1 - early.speed / one.speed),
        "no_switch": number(speeds["dual-rate"][0], 2),
        "switch": number(speeds["dual-rate"][at], 2),
        "rises": {method: f"{float(rise):.0f}" for method, rise in rises.items()},
        "even": number(even, 1),
    }


def about_noise(found: Sequence[Approximated], paper: Mapping[str, CostTable]) -> dict[str, Any]:
    """Of Q' and Q''."""
    of = {
        noise: {
            "P": percent(max(one.covariance for one in found if one.noise == noise)),
            "estimate": significant(100 * max(one.estimate for one in found if one.noise == noise), 1) + " %",
            "small": significant(100 * min(one.covariance for one in found if one.noise == noise), 1) + " %",
        }
        for noise in ("sum", "euler")
    }
    counted = paper["counted"]
    return {
        **of,
        "ever": {
            noise: {"P": percent(most.covariance), "estimate": significant(100 * most.estimate, 2) + " %"}
            for noise, most in worst().items()
        },
        "many": MANY_CYCLES,
        "cycles": {name: system.cycles for name, system in tried().items()},
        "least_share": significant(100 * min(one.share for one in found), 1) + " %",
        "most_share": percent(max(one.share for one in found)),
        "exact_speed": number(least(counted, "dual-rate", FIGURE_3)),
        "sum_speed": number(least(counted, "dual-rate", FIGURE_3, Options(low_rate_noise="sum"))),
    }


def about_deadlines(paper: CostTable) -> dict[str, Any]:
    """Of the rules "by m" and "by l", over every design of the same N: for which M the second needs less, and what
    share less, from and to."""
    N, first = FIGURE_3.N, SMALL_DELAYS[0]
    saved = {}
    for timing in (Timing(N, M, L) for M in range(N) for L in range(M + 1, N + 1)):
        by_m, by_l = (least(paper, "dual-rate", timing, options) for options in (Options(), BY_L))
        saved[timing] = 1 - by_l / by_m
    less = {timing: share for timing, share in saved.items() if share > 0}
    return {
        "by_m": number(least(paper, "dual-rate", first), 4),
        "by_l": number(least(paper, "dual-rate", first, BY_L), 4),
        "N": N,
        "designs": len(saved),
        "M": ", ".join(map(str, sorted({timing.M for timing in less}))),
        "least": percent(min(less.values())),
        "most": percent(max(less.values())),
        "here": percent(less[first]),
    }


def equations() -> list[str]:
    """Each as an item of a list: its maths, then the line of code and where it is."""
    items = []
    for one in EQUATIONS:
        run = f"no line: {one.note}"
        if one.function is not None:
            folder, _, file = one.file.rpartition("/")
            note = f"; {one.note}" if one.note else ""
            run = f"`{one.line}` in `{one.function.__name__}`, {file} in {folder}{note}"
        items.append(f"**({one.number})** {one.maths}<br>{run}")
    return items
