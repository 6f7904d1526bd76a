"""`sched-sim simulate`: run one filter's jobs, or a whole scenario, on the simulated processor."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from sched_sim.cli import options as opt
from sched_sim.cli import scenario_flags as flags
from sched_sim.cli.chart_options import From, Until, stretch
from sched_sim.cli.design_flags import with_options
from sched_sim.cli.output import lines, print_csv, print_json, say
from sched_sim.cli.outputs import refuse_one_file_for_two
from sched_sim.cli.progress import progress_bar
from sched_sim.design.options import Options
from sched_sim.errors import InputError
from sched_sim.rounding import percent_up

if TYPE_CHECKING:
    from sched_sim.design.pieces import Costs
    from sched_sim.design.timing import Timing
    from sched_sim.schedule.outcome import Slice
    from sched_sim.schedule.tasks import Task

GanttFile = Annotated[
    Path | None,
    typer.Option("--gantt", help="Draw the schedule: FILE.svg, .pdf or .png.", rich_help_panel=opt.OUTPUT),
]
TraceFiles = Annotated[
    list[Path] | None,
    typer.Option(
        "--trace",
        help="Every slice: FILE.json (Chrome Trace Event, opens in Perfetto) or FILE.csv, in ms with --hr-hz, else in "
        "HR periods. Repeatable.",
        rich_help_panel=opt.OUTPUT,
    ),
]


ScenarioFile = Annotated[
    Path | None,
    typer.Option(
        "--scenario",
        help="TOML file of a predictor and several sensors, several measurements on their way at once, dropout, random "
        "delay and measured costs; instead of the options for one filter. With hr_hz, the steps in a second, times are "
        "as you have them. At least: name, hr_hz, duration_s, \\[predictor] cost_us, \\[\\[sensor]] name, hz, cost_us; "
        "a sensor's delay_ms is 0 by default. With speed, cost units per HR period: name, steps, \\[predictor] cost, "
        "\\[\\[sensor]] name, every, cost. The deadline land_by is by default the longest delay + every - 1, in steps.",
        rich_help_panel=opt.DESIGN,
    ),
]
HistogramFile = Annotated[
    Path | None,
    typer.Option(
        "--histogram",
        help="With --scenario: draw the distributions of response times and of achieved l: FILE.svg, .pdf or .png.",
        rich_help_panel=opt.OUTPUT,
    ),
]
LessWorkToo = Annotated[
    bool,
    typer.Option(
        "--less-work",
        help="Say too whether a deadline is missed where executions take less than their costs: then a correction may "
        "land in another step.",
        rich_help_panel=opt.OUTPUT,
    ),
]
ABOUT_ACCURACY = flags.Asked._fields
PICTURES = ("gantt", "first", "until", "histogram")
WITH_SCENARIO = ("scenario", *PICTURES, "trace", "rare", "engine", "format", *ABOUT_ACCURACY)
"""The parameters that go together with --scenario; what the others say, the scenario says itself."""


@with_options
def simulate(
    context: typer.Context,
    N: opt.StepsOrNone = None,
    M: opt.Delay = None,
    L: opt.FeedbackStep = None,
    hr_hz: opt.HrHz = None,
    measurement_hz: opt.MeasurementHz = None,
    delay_ms: opt.DelayMs = None,
    land_within_ms: opt.LandWithinMs = None,
    method: opt.OneMethod = "dual-rate",
    speed: opt.Speed = None,
    cycles: opt.Cycles = 3,
    costs: opt.Costs = None,
    statistic: opt.WhichCost = "minimum",
    processor: opt.OnProcessor = None,
    options: Options = Options(),
    tasks: opt.Tasks = None,
    gantt: GanttFile = None,
    first: From = None,
    until: Until = None,
    trace: TraceFiles = None,
    less_work: LessWorkToo = False,
    scenario: ScenarioFile = None,
    histogram: HistogramFile = None,
    model: flags.ScenarioModel = None,
    output: flags.ScenarioOutput = None,
    unit: flags.ScenarioUnit = None,
    initial_std: flags.StartStd = None,
    times_slower: flags.TimesSlower = None,
    rare: flags.Rare = False,
    engine: opt.WhichEngine = "auto",
    format: opt.Format = "table",
) -> None:
    """Run one filter's jobs on the simulated preemptive processor: achieved l, misses, response times.

    sched-sim simulate -N 10 -M 4 --speed 0.78 --gantt schedule.svg
    sched-sim simulate -N 10 -M 4 --method larsen --speed 1.2 --trace slices.json
    sched-sim simulate -N 40 -M 20 --processor cortex-m7 --hr-hz 400
    sched-sim simulate --scenario rocket.toml --histogram rocket.svg
    sched-sim simulate --scenario rocket.toml --model mymodule:my_model --output position=0:3 --times-slower 2
    """
    outputs = [("--histogram", histogram), ("--gantt", gantt), *(("--trace", path) for path in trace or ())]
    inputs = [("--scenario", scenario), ("--costs", costs), ("--processor", processor), ("--tasks", tasks)]
    refuse_one_file_for_two(outputs, inputs)
    if gantt is None and (given := opt.given_options(context, lambda name: name in ("first", "until"))):
        raise InputError(f"{', '.join(given)} says what a picture shows: give --gantt FILE.svg too")
    if scenario is not None:
        from sched_sim.cli.scenario import Picture, simulate_scenario

        _refuse_beside_scenario(context, scenario)
        asked = flags.Asked(model, output, unit, initial_std, times_slower)
        picture = Picture(gantt, first, until)
        simulate_scenario(scenario, picture, trace or (), histogram, asked, outputs, format, engine, rare)
        return
    if given := opt.given_options(context, lambda name: name in ABOUT_ACCURACY):
        raise InputError(
            f"{', '.join(given)}: the accuracy along a simulation is of a scenario: give --scenario FILE.toml too; "
            f"that of one filter in its cycle is `sched-sim accuracy`"
        )
    if histogram is not None:
        raise InputError(f"--histogram {histogram} is for random times: give --scenario FILE.toml too")
    if rare:
        raise InputError("--rare is of a scenario: give --scenario FILE.toml too")
    if N is None and measurement_hz is None:
        raise InputError(
            "-N is missing: give the HR steps between measurements, such as -N 10, or --scenario FILE.toml"
        )
    from contextlib import ExitStack

    from sched_sim.cli.caveats import caveat_note, with_caveats
    from sched_sim.cli.instructions import board_row
    from sched_sim.cli.measured_note import busy_row, say_of_statistic
    from sched_sim.cli.simulated import of_run, outcome, responses, show
    from sched_sim.cli.update_form import update_form, update_note
    from sched_sim.costs.methods import MULTIRATE_METHODS
    from sched_sim.design.least_speed import least_speed
    from sched_sim.design.methods import select
    from sched_sim.design.simulate import simulate as run
    from sched_sim.design.stated import Stated
    from sched_sim.schedule.trace import check_trace, open_trace

    if gantt is not None:
        from reports.drawing.picture import check_picture

        check_picture(gantt, "--gantt")
    for path in trace or ():
        check_trace(path)
    part = opt.make_processor(processor)
    table, rate = opt.costs_on(costs, part), opt.hr_rate(hr_hz)
    design = Stated.of(N, M, L, rate, measurement_hz, delay_ms, land_within_ms)
    timing = design.timing(method, options)
    others = opt.make_tasks(tasks, table.unit, rate)
    work = select(table, method, options, statistic)
    pace = opt.pace(speed, rate, part, lambda: least_speed(work, timing, options, others))
    achieved: list[int | None] = [None] * cycles

    def landed(cycle: int, at: int) -> None:
        achieved[cycle] = at

    with ExitStack() as files:
        traces = [files.enter_context(open_trace(path, rate)) for path in trace or ()]

        def write(piece: Slice) -> None:
            for write_piece in traces:
                write_piece(piece)

        progress = files.enter_context(progress_bar("Simulating"))
        schedule = run(
            work,
            timing,
            pace,
            cycles,
            options,
            others,
            engine=engine,
            on_slice=write if traces else None,
            on_landing=landed,
            on_progress=progress,
        )
    if gantt is not None:
        from reports.charts.chart import gantt as draw
        from reports.charts.chart import method_panel, save
        from reports.charts.panels import zoomed

        panel = method_panel(table, method, timing, pace, cycles, options, others, statistic=statistic)
        if first is not None or until is not None:
            panel = zoomed(panel, *stretch(first, until, rate, panel.end))
        save(draw([panel], hr_hz=rate), gantt, "--gantt")
    say_of_statistic(statistic, [table])
    if together := released_together(work, timing, pace, options, others):
        say(f"Note: {together}")
    if not schedule.misses and (note := unseen(work, timing, pace, cycles, options, others)):
        say(f"Note: {note}")
    if start := of_the_start(work, timing, pace, options, others):
        say(f"Note: {start}")
    wait = Fraction(0) if rate is None or design.times is None else design.times.wait(rate)
    about_run = of_run(method, timing, pace, table.unit, rate, part)
    (about,) = with_caveats(
        [about_run | update_form(table, method) | board_row(table, method) | busy_row(table.provenance)]
    )
    less_note = ""
    if less_work:
        from sched_sim.cli.less_work import row_of, said
        from sched_sim.design.less_work import less_work as look

        found = look(work, timing, pace, options, others)
        about |= row_of(found)
        less_note = said(found, work, others)
    if format == "json":
        print_json(about | outcome(schedule, achieved, rate, wait))
    elif format == "csv":
        print_csv([about | {"kind": kind} | figures for kind, figures in responses(schedule, rate).items()])
    else:
        delay = "" if design.M is None else f" M={timing.M}"
        where = f"at speed {float(pace):.6g}" if part is None else f"on {part.title}"
        if part is not None and rate is None:
            where += f", as fast as it can: HR period {1e6 * float(pace):.6g} us"
        title = f"{method}, N={design.N}{delay} L={timing.L}, {where}"
        note = lines(less_note, design.words, caveat_note([method]), update_note(table, [method]))
        show(title, schedule, achieved, rate, wait, method in MULTIRATE_METHODS, note)


def unseen(
    costs: Costs, timing: Timing, speed: Fraction, cycles: int, options: Options, tasks: Sequence[Task]
) -> str | None:
    """What is still to come after so many measurement cycles without a miss, in words; None if nothing new."""
    from sched_sim.design.least_speed import has_closed_form
    from sched_sim.design.load import loads
    from sched_sim.schedule.tasks import phases_matter

    shown = f"{cycles} {'cycle is' if cycles == 1 else 'cycles are'} shown"
    if (most := max(loads(costs, timing, speed, options, tasks))) > 1:
        return f"{shown}; the work is {_above(most)} of what the processor can do, and piles up without end"
    if has_closed_form(options, tasks, costs, timing):
        return None
    if phases_matter(tasks):
        return _at_another_phase(costs, timing, speed, options, tasks)
    from sched_sim.design.steady import run_until_steady

    try:
        steady = run_until_steady(costs, timing, speed, options, tasks)
    except InputError as error:
        return f"{shown}; not all is seen: {error}"
    needed = timing.taken.before(steady.steps)
    if needed <= cycles:
        return None
    if steady.repeats:
        return f"{shown}; {'with these tasks ' if tasks else ''}all is seen after {needed}: --cycles {needed}"
    if steady.schedule.misses:
        return f"{shown}; a deadline is missed within {needed}: --cycles {needed}"
    return f"{shown}; work piles up slowly: after {needed} cycles it had not come to rest, and nothing was missed yet"


def of_the_start(costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]) -> str | None:
    """That a simulation begins before any measurement is there, and how busy the processor is once the filter runs, in
    words; None where that is not known without a simulation, or no more are on their way later."""
    from sched_sim.design.least_speed import has_closed_form
    from sched_sim.design.load import loads

    if timing.M <= timing.N or not has_closed_form(options, tasks, costs, timing):
        return None
    load = loads(costs, timing, speed, options)[0]
    return (
        f"shown from the start on: no measurement is there before step {timing.M}; once the filter has been running, "
        f"the load is {percent_up(load)}"
    )


def _at_another_phase(
    costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]
) -> str | None:
    from sched_sim.cli.parts import fixed_by
    from sched_sim.design.any_phase import LOAD, late_job

    try:
        late = late_job(costs, timing, speed, options, tasks)
    except InputError as error:
        return f"not all is seen: {error}"
    if late == LOAD:
        return "at another phase of the tasks something may be late: the work is nearly all that the processor can do"
    return None if late is None else f"at another phase of the tasks {fixed_by(late)} may be late"


def released_together(
    costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]
) -> str | None:
    """At which step tasks of any phase are released together in a simulation, what that is the worst for, and what it
    does not show, in words; None if there are none."""
    from sched_sim.design.load import loads
    from sched_sim.design.simulate import worst_start

    start = worst_start(costs, timing, speed, options, tasks)
    if start is None:
        return None
    step = f"{float(start):.6g}"
    worst = ", the worst for the job with the least slack, not for the landing" if options.policy == "fixed" else ""
    names = ", ".join(task.name for task in tasks if _would_block(task, tasks, options))
    block = f"; {names}: not preemptive, and would block more if released just before" if names else ""
    waiting = ", ".join(task.name for task in tasks if _waits(task, start))
    load = sum(loads(costs, timing, speed, options, tasks)) / options.cpus
    busy = (
        "" if options.context_switch else f": the processor is busy for less than the load, {float(100 * load):.3g} %"
    )
    idle = f"; {waiting}: with jitter, and not released before{busy}" if waiting else ""
    return f"tasks of any phase are released together at step {step}{worst}{block}{idle}"


def _waits(task: Task, start: Fraction) -> bool:
    """Whether a task of any phase is released less often in a simulation than it would be, see `at_worst_phase`."""
    return task.offset == "any" and task.jitter > 0 and start - task.jitter >= task.period


def _would_block(task: Task, tasks: Sequence[Task], options: Options) -> bool:
    """Whether a task of any phase delays something more urgent by all of its cost where it comes just before it."""
    from sched_sim.schedule.jobs import HR, LR

    if task.preemptive or task.offset != "any":
        return False
    filter_jobs = [HR] if task.cpu == 1 else [LR]
    others = [other.priority for other in tasks if other.cpu == task.cpu and other is not task]
    return options.policy == "edf" or task.priority > min(filter_jobs + others)


def _above(share: Fraction) -> str:
    """A share above 1 in percent, which never reads as 100 %."""
    return f"{float(100 * share):.4g} %" if share > Fraction(1001, 1000) else "a little more than 100 %"


def _refuse_beside_scenario(context: typer.Context, scenario: Path) -> None:
    """Raises InputError that names the options which the scenario would not follow."""
    options = opt.given_options(context, lambda name: name not in WITH_SCENARIO)
    if options:
        raise InputError(
            f"{', '.join(options)} and --scenario {scenario} exclude each other: the file says what is simulated; "
            f"leave {'it' if len(options) == 1 else 'them'} out, or edit the file"
        )
