"""`sched-sim gantt`: schedules as a picture, one below the other."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from sched_sim.cli import options as opt

ChartMethods = Annotated[
    list[str] | None,
    typer.Option("--method", help="Repeatable; by default larsen and dual-rate.", rich_help_panel=opt.DESIGN),
]
Picture = Annotated[Path, typer.Option("--output", "-o", help="FILE.svg, .pdf or .png.", rich_help_panel=opt.OUTPUT)]


def gantt(
    N: opt.Steps,
    M: opt.Delay,
    L: opt.FeedbackStep = None,
    method: ChartMethods = None,
    speed: opt.Speed = None,
    cycles: opt.Cycles = 1,
    costs: opt.Costs = "steffes2014",
    statistic: opt.WhichCost = "minimum",
    lr_propagate_by: opt.LrPropagateBy = "m",
    feedback: opt.FeedbackIn = "next-step",
    gain: opt.GainAt = "at-update",
    low_rate_noise: opt.Noise = "exact",
    cpus: opt.Cpus = 1,
    context_switch: opt.ContextSwitch = "0",
    tasks: opt.Tasks = None,
    output: Picture = Path("gantt.svg"),
) -> None:
    """Draw a Gantt chart: each method at its own least speed, or all at one --speed.

    sched-sim gantt -N 10 -M 4 -L 8 -o fig3.pdf
    """
    from reports.gantt import gantt as draw
    from reports.gantt import method_panel, save
    from reports.picture import check_picture
    from sched_sim.costs import load, select
    from sched_sim.least_speed import least_speed
    from sched_sim.ticks import positive

    check_picture(output)
    options = opt.make_options(lr_propagate_by, feedback, gain, low_rate_noise, cpus, context_switch)
    table, others = load(costs), opt.make_tasks(tasks)
    panels = []
    for name in opt.wanted_methods(method or ["larsen", "dual-rate"]):
        timing = opt.make_timing(N, M, L, name, options)
        work = select(table, name, options, statistic)
        pace = least_speed(work, timing, options, others).speed if speed is None else positive(speed, "--speed")
        panels.append(method_panel(table, name, timing, pace, cycles, options, others, statistic=statistic))
    save(draw(panels), output)
    typer.echo(f"Wrote {output}", err=True)
