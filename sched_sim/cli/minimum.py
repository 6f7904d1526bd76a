"""`sched-sim minimum`: the least processor that meets every deadline."""

from __future__ import annotations

from typing import Any

from sched_sim.cli import options as opt
from sched_sim.cli.output import print_csv, print_json, print_table, units

SECONDS = {"second": 1.0, "seconds": 1.0, "s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
"""Units of costs that are times: then work per second is a share of the processor on which they were found."""

LARGEST_DENOMINATOR = 10_000
"""A fraction with a larger one (of measured costs) tells a person nothing; --format json has it."""


def minimum(
    N: opt.Steps,
    M: opt.Delay,
    L: opt.FeedbackStep = None,
    method: opt.Methods = None,
    costs: opt.Costs = "steffes2014",
    statistic: opt.WhichCost = "minimum",
    lr_propagate_by: opt.LrPropagateBy = "m",
    feedback: opt.FeedbackIn = "next-step",
    gain: opt.GainAt = "at-update",
    low_rate_noise: opt.Noise = "exact",
    cpus: opt.Cpus = 1,
    context_switch: opt.ContextSwitch = "0",
    tasks: opt.Tasks = None,
    hr_hz: opt.HrHz = None,
    format: opt.Format = "table",
) -> None:
    """The least processor speed at which each method meets every deadline, and which demand fixes it.

    sched-sim minimum -N 10 -M 4 -L 8
    sched-sim minimum -N 40 -M 4 --hr-hz 400 --costs my-costs.toml --method dual-rate
    """
    from sched_sim.analysis import BINDING_WORDS
    from sched_sim.costs import load, select
    from sched_sim.least_speed import achieved_l, least_speed
    from sched_sim.search import cycles_to_simulate
    from sched_sim.simulate import simulate

    options = opt.make_options(lr_propagate_by, feedback, gain, low_rate_noise, cpus, context_switch)
    table, others, rate = load(costs), opt.make_tasks(tasks), opt.hr_rate(hr_hz)
    rows: list[dict[str, Any]] = []
    shown: list[dict[str, Any]] = []
    for name in opt.wanted_methods(method):
        timing = opt.make_timing(N, M, L, name, options)
        work = select(table, name, options, statistic)
        least = least_speed(work, timing, options, others)
        row = {
            "method": name,
            "N": N,
            "M": M,
            "L": timing.L,
            "min_speed": float(least.speed),
            "min_speed_exact": str(least.speed),
            "binding": least.binding,
        }
        landed: int | None
        if others or options.context_switch:
            cycles = cycles_to_simulate(timing, others)
            landed = max(simulate(work, timing, least.speed, cycles, options, others).achieved)
        else:
            landed = achieved_l(work, timing, least.speed, options)
        person = {
            "method": "standard (no delay)" if name == "standard" else name,
            "least speed": f"{float(least.speed):.6g}",
            "exactly": str(least.speed) if least.speed.denominator <= LARGEST_DENOMINATOR else "-",
            "fixed by": BINDING_WORDS.get(least.binding, least.binding),
            "lands at L": landed,
        }
        if rate is not None:
            assert landed is not None
            times = _absolute(rate, landed, float(least.speed), table.unit)
            row |= {"hr_hz": rate, **times}
            person |= {_heading(key, table.unit): f"{value:.4g}" for key, value in times.items()}
        rows.append(row)
        shown.append(person)
    if format == "json":
        print_json(rows)
    elif format == "csv":
        print_csv(rows)
    else:
        print_table(
            f"Least speed, N={N} M={M} L={'latest' if L is None else L}, in {units(table.unit)} per HR period "
            f"(costs: {table.name})",
            shown,
        )


def _absolute(rate: float, L: int, speed: float, unit: str) -> dict[str, float]:
    """What the design is in seconds: when the correction lands, and the work per second the processor must do."""
    times = {"correction_ms": 1000 * L / rate, "work_per_second": speed * rate * SECONDS.get(unit, 1)}
    if unit in SECONDS:
        times["highest_hr_hz"] = 1 / (speed * SECONDS[unit])
    return times


def _heading(key: str, unit: str) -> str:
    if key == "work_per_second":
        return "share of processor" if unit in SECONDS else f"{units(unit)} per s"
    return {"correction_ms": "lands after, ms", "highest_hr_hz": "highest HR Hz"}[key]
