"""`sched-sim gantt`: schedules as a picture, one below the other."""

from __future__ import annotations

from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.chart_options import From, Until, Width, stretch, width_mm
from sched_sim.cli.design_flags import with_options
from sched_sim.cli.output import lines, say
from sched_sim.cli.outputs import refuse_one_file_for_two
from sched_sim.cli.refused import Refused
from sched_sim.design.options import Options

if TYPE_CHECKING:
    from sched_sim.costs.table import CostTable

ChartMethods = Annotated[
    list[str] | None,
    typer.Option("--method", help="Repeatable; by default larsen and dual-rate.", rich_help_panel=opt.DESIGN),
]
Picture = Annotated[Path, typer.Option("--output", "-o", help="FILE.svg, .pdf or .png.", rich_help_panel=opt.OUTPUT)]


@with_options
def gantt(
    N: opt.StepsOrNone = None,
    M: opt.Delay = None,
    L: opt.FeedbackStep = None,
    hr_hz: opt.HrHz = None,
    measurement_hz: opt.MeasurementHz = None,
    delay_ms: opt.DelayMs = None,
    land_within_ms: opt.LandWithinMs = None,
    method: ChartMethods = None,
    speed: opt.Speed = None,
    cycles: opt.Cycles = 1,
    costs: opt.Costs = None,
    statistic: opt.WhichCost = "minimum",
    processor: opt.OnProcessor = None,
    options: Options = Options(),
    tasks: opt.Tasks = None,
    width: Width = "170mm",
    first: From = None,
    until: Until = None,
    output: Picture = Path("gantt.svg"),
) -> None:
    """Draw a Gantt chart: each method at its own least speed, or all at one --speed or on one --processor.

    sched-sim gantt -N 10 -M 4 -L 8 -o fig3.pdf
    sched-sim gantt -N 40 -M 20 --processor cortex-m7 --hr-hz 400
    sched-sim gantt -N 40 -M 20 --hr-hz 400 --from 45ms --until 80ms --width 88mm -o column.pdf
    """
    from functools import partial

    from reports.charts.chart import gantt as draw
    from reports.charts.chart import method_panel, save
    from reports.charts.panels import zoomed
    from reports.drawing.picture import check_picture
    from sched_sim.cli.caveats import caveat_note
    from sched_sim.cli.measured_note import say_of_statistic
    from sched_sim.cli.simulate import of_the_start, released_together
    from sched_sim.cli.update_form import counted_note
    from sched_sim.design.least_speed import least_speed
    from sched_sim.design.methods import select
    from sched_sim.design.stated import Stated

    check_picture(output, "--output")
    across = width_mm(width)
    inputs = [("--costs", costs), ("--processor", processor), ("--tasks", tasks)]
    refuse_one_file_for_two([("--output", output)], inputs)
    part = opt.make_processor(processor)
    table, rate = opt.costs_on(costs, part), opt.hr_rate(hr_hz)
    others = opt.make_tasks(tasks, table.unit, rate)
    design = Stated.of(N, M, L, rate, measurement_hz, delay_ms, land_within_ms)
    say_of_statistic(statistic, [table])
    panels, longer, methods = [], [], opt.wanted_methods(method or _usual(table), table)
    refused = Refused(methods)
    for name in methods:
        with refused.noting(name, design.why_none(name, options)):
            timing = design.timing(name, options)
            work = select(table, name, options, statistic)
            pace = opt.pace(speed, rate, part, partial(least_speed, work, timing, options, others))
            remarks = [remark(work, timing, pace, options, others) for remark in (released_together, of_the_start)]
            drawn = partial(method_panel, table, name, timing, pace, options=options, tasks=others, statistic=statistic)
            panels.append(drawn(cycles=cycles))
            longer.append((timing.N, drawn))
            for words in filter(None, remarks):
                say(f"Note: {name}: {words}")
    refused.say()
    if first is not None or until is not None:
        start, end = stretch(first, until, rate, max(panel.end for panel in panels))
        for number, (N, drawn) in enumerate(longer):
            if panels[number].end < end:
                panels[number] = drawn(cycles=cycles + ceil((end - panels[number].end) / N))
        panels = [zoomed(panel, start, end) for panel in panels]
    save(draw(panels, width_mm=across, hr_hz=rate), output, "--output")
    left = [name for name in methods if name not in refused.notes]
    for words in lines(design.words, caveat_note(left), counted_note(table)).splitlines():
        say(words)
    say(f"Wrote {output}")


def _usual(table: CostTable) -> list[str]:
    return [method for method in ("larsen", "dual-rate") if method in table.costs]
