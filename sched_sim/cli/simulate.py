"""`sched-sim simulate`: run one filter's jobs on the simulated processor."""

from __future__ import annotations

from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.output import print_csv, print_json, print_table

if TYPE_CHECKING:
    from sched_sim.schedule import Response, Slice

GanttFile = Annotated[
    Path | None,
    typer.Option("--gantt", help="Draw the schedule: FILE.svg, .pdf or .png.", rich_help_panel=opt.OUTPUT),
]
TraceFiles = Annotated[
    list[Path] | None,
    typer.Option(
        "--trace",
        help="Every slice: FILE.json (Chrome Trace Event, opens in Perfetto) or FILE.csv. Repeatable.",
        rich_help_panel=opt.OUTPUT,
    ),
]


def simulate(
    N: opt.Steps,
    M: opt.Delay,
    L: opt.FeedbackStep = None,
    method: opt.OneMethod = "dual-rate",
    speed: opt.Speed = None,
    cycles: opt.Cycles = 3,
    costs: opt.Costs = "steffes2014",
    statistic: opt.WhichCost = "minimum",
    lr_propagate_by: opt.LrPropagateBy = "m",
    feedback: opt.FeedbackIn = "next-step",
    gain: opt.GainAt = "at-update",
    low_rate_noise: opt.Noise = "exact",
    cpus: opt.Cpus = 1,
    context_switch: opt.ContextSwitch = "0",
    tasks: opt.Tasks = None,
    gantt: GanttFile = None,
    trace: TraceFiles = None,
    hr_hz: opt.HrHz = None,
    format: opt.Format = "table",
) -> None:
    """Run one filter's jobs on the simulated preemptive processor: achieved l, misses, response times.

    sched-sim simulate -N 10 -M 4 --speed 0.78 --gantt schedule.svg
    sched-sim simulate -N 10 -M 4 --method larsen --speed 1.2 --trace slices.json
    """
    from contextlib import ExitStack

    from sched_sim.costs import load, select
    from sched_sim.least_speed import least_speed
    from sched_sim.simulate import simulate as run
    from sched_sim.ticks import positive
    from sched_sim.trace import open_trace

    options = opt.make_options(lr_propagate_by, feedback, gain, low_rate_noise, cpus, context_switch)
    timing = opt.make_timing(N, M, L, method, options)
    table, others, rate = load(costs), opt.make_tasks(tasks), opt.hr_rate(hr_hz)
    work = select(table, method, options, statistic)
    pace = least_speed(work, timing, options, others).speed if speed is None else positive(speed, "--speed")
    achieved: list[int | None] = [None] * cycles

    def landed(cycle: int, at: int) -> None:
        achieved[cycle] = at

    with ExitStack() as files:
        scale = 1000.0 if rate is None else 1e6 / rate
        traces = [files.enter_context(open_trace(path, scale)) for path in trace or ()]

        def write(piece: Slice) -> None:
            for one in traces:
                one(piece)

        schedule = run(
            work,
            timing,
            pace,
            cycles,
            options,
            others,
            on_slice=write if traces else None,
            on_landing=landed,
        )
    if gantt is not None:
        from reports.gantt import gantt as draw
        from reports.gantt import method_panel, save

        save(draw([method_panel(table, method, timing, pace, cycles, options, others, statistic=statistic)]), gantt)
    response = {kind: _response(figures, schedule.period) for kind, figures in schedule.responses.items()}
    document = {
        "achieved_l": achieved,
        "misses": schedule.misses,
        "utilization": float(schedule.utilization),
        "preemptions": schedule.preemptions,
        "response": response,
    }
    if rate is not None:
        document["hr_hz"] = rate
        document["correction_ms"] = [None if at is None else 1000 * at / rate for at in achieved]
    if format == "json":
        print_json(document)
    elif format == "csv":
        print_csv([{"kind": kind, **figures} for kind, figures in response.items()])
    else:
        _show(f"{method}, N={N} M={M} L={timing.L}, at speed {float(pace):.6g}", document, rate)


def _response(figures: Response, period: int) -> dict[str, Any]:
    return {
        "max": figures.worst / period,
        "mean": float(figures.mean / period),
        "releases": figures.releases,
        "misses": figures.misses,
        "worst_lateness": figures.worst_lateness / period,
        "preemptions": figures.preemptions,
    }


def _show(title: str, document: dict[str, Any], rate: float | None) -> None:
    unit, scale = ("HR periods", 1.0) if rate is None else ("ms", 1000 / rate)
    rows = [
        {
            "job": kind,
            "jobs": figures["releases"],
            "worst": f"{figures['max'] * scale:.4g}",
            "mean": f"{figures['mean'] * scale:.4g}",
            "missed": figures["misses"],
            "late by": f"{figures['worst_lateness'] * scale:.4g}",
            "preempted": figures["preemptions"],
        }
        for kind, figures in document["response"].items()
    ]
    landings = ", ".join(runs(document["achieved_l"]))
    note = f"Corrections land at l = k + {landings}; processor busy {document['utilization']:.1%} of the time"
    print_table(f"{title}; response times in {unit}", rows, note)


def runs(values: list[int | None]) -> list[str]:
    """Equal neighbours in one: [8, 8, 8, 9] is ["8 (3 cycles)", "9 (1 cycle)"]."""
    found = []
    for value, group in groupby(values):
        count = len(list(group))
        name = "(not within the simulated time)" if value is None else str(value)
        found.append(f"{name} ({count} cycle{'s' if count > 1 else ''})")
    return found
