"""What a processor does, step by step, as columns that a Gantt chart is drawn from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from sched_sim.design.cycle_marks import cycle_marks
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs
from sched_sim.design.simulate import at_worst_phase, in_ticks, simulated_steps
from sched_sim.design.timing import Timing
from sched_sim.schedule import intervals
from sched_sim.schedule.intervals import TASK, JobSpan, Row
from sched_sim.schedule.labels import MEANINGS
from sched_sim.schedule.outcome import Schedule, Slice
from sched_sim.schedule.processor import Processor
from sched_sim.schedule.tasks import Task
from sched_sim.text import visible

MOST_BARS = 20_000
"""About so many are made: a browser draws them at once."""

BARS_OF_A_STEP = 2
"""At the least, of a filter whose LR jobs are interrupted in each step."""


@dataclass(frozen=True, slots=True)
class Style:
    """A label of work, "task:NAME" for a user's task, and what it means."""

    label: str
    meaning: str


@dataclass(frozen=True, slots=True)
class StepMark:
    """A step that the paper names, such as m."""

    step: int
    label: str
    meaning: str


@dataclass(frozen=True, slots=True)
class Line:
    """A line of the chart; cpu: from 0, None if there is no job of it."""

    name: str
    cpu: int | None


@dataclass(frozen=True, slots=True)
class Jobs:
    """Columns, a job in each place, by release. row: index of its line; times in HR periods, None for never; missed:
    by the end of what was simulated; preemptions: how often another took its processor."""

    row: list[int]
    kind: list[str]
    step: list[int]
    release: list[float]
    start: list[float | None]
    finish: list[float | None]
    deadline: list[float]
    missed: list[bool]
    preemptions: list[int]


@dataclass(frozen=True, slots=True)
class Bars:
    """Columns, a piece of work in each place, done without interruption; row, style, job: indices."""

    row: list[int]
    style: list[int]
    start: list[float]
    end: list[float]
    job: list[int]


@dataclass(frozen=True, slots=True)
class Timeline:
    """steps: how many are shown; cut: of how many, in words, empty where these are all. misses: in these; busy: the
    share of the processors' time."""

    steps: int
    period_ms: float | None
    cut: str
    rows: tuple[Line, ...]
    styles: tuple[Style, ...]
    jobs: Jobs
    bars: Bars
    marks: tuple[StepMark, ...]
    misses: int
    busy: float


def timeline(
    costs: Costs,
    timing: Timing,
    speed: Fraction,
    cycles: int,
    options: Options,
    tasks: Sequence[Task],
    period_ms: float | None,
) -> Timeline:
    """The schedule that `simulate` makes, or as many steps of it as make about MOST_BARS. Raises InputError as
    `simulate` does."""
    tasks = at_worst_phase(costs, timing, speed, options, tasks)
    wanted = simulated_steps(costs, timing, cycles, options)
    steps = min(wanted, most_steps(tasks))
    landings: dict[int, int] = {}
    schedule = _simulated(costs, timing, speed, steps, options, tasks, landings)
    named = cycle_marks(timing, cycles if steps == wanted else _cycles(timing, steps), landings, end=steps)
    marks = [StepMark(mark.step, mark.text, mark.meaning) for mark in named if mark.step <= steps]
    cut = "" if steps == wanted else f"the first {steps:,} of {wanted:,} steps"
    return shown(schedule, steps, marks, cut, period_ms)


def shown(
    schedule: Schedule,
    steps: int,
    marks: Sequence[StepMark] = (),
    cut: str = "",
    period_ms: float | None = None,
) -> Timeline:
    """Any schedule that was simulated with its slices kept."""
    spans, lines = intervals.jobs(schedule), intervals.rows(schedule)
    number = {line: index for index, line in enumerate(lines)}
    bars, styles = _bars(schedule, spans, number)
    return Timeline(
        steps,
        period_ms,
        cut,
        tuple(Line(visible(line.name), line.cpu) for line in lines),
        styles,
        _jobs(spans, number, schedule.period),
        bars,
        tuple(marks),
        schedule.misses,
        float(schedule.utilization),
    )


def most_steps(tasks: Sequence[Task]) -> int:
    """That are simulated."""
    return max(int(MOST_BARS / (BARS_OF_A_STEP + sum(BARS_OF_A_STEP / task.period for task in tasks))), 1)


def _cycles(timing: Timing, steps: int) -> int:
    """That begin in so many steps."""
    return max(timing.taken.before(steps), 1)


def _simulated(
    costs: Costs,
    timing: Timing,
    speed: Fraction,
    steps: int,
    options: Options,
    tasks: Sequence[Task],
    landings: dict[int, int],
) -> Schedule:
    run = in_ticks(costs, timing, speed, options, tasks)
    slices: list[Slice] = []
    sources = [run.source(landings.__setitem__), *run.tasks]
    processor = Processor(sources, run.period, steps * run.period, run.platform, slices.append)
    processor.run()
    return replace(processor.schedule(), slices=tuple(slices))


def _jobs(spans: Sequence[JobSpan], number: dict[Row, int], period: int) -> Jobs:
    return Jobs(
        [number[span.row] for span in spans],
        [visible(span.kind) for span in spans],
        [span.step for span in spans],
        [span.release / period for span in spans],
        [None if (start := _start(span)) is None else start / period for span in spans],
        [None if span.finish is None else span.finish / period for span in spans],
        [span.deadline / period for span in spans],
        [span.missed for span in spans],
        [span.preemptions for span in spans],
    )


def _start(span: JobSpan) -> int | None:
    """Of one without work when it was done."""
    return span.runs[0][0] if span.runs else span.finish


def _bars(schedule: Schedule, spans: Sequence[JobSpan], number: dict[Row, int]) -> tuple[Bars, tuple[Style, ...]]:
    made, period = intervals.bars(schedule), schedule.period
    of_job = {(span.kind, span.step): index for index, span in enumerate(spans)}
    labels = {label: index for index, label in enumerate(dict.fromkeys(bar.style for bar in made))}
    bars = Bars(
        [number[bar.row] for bar in made],
        [labels[bar.style] for bar in made],
        [bar.start / period for bar in made],
        [bar.end / period for bar in made],
        [of_job[bar.kind, bar.step] for bar in made],
    )
    return bars, tuple(Style(visible(label), visible(meaning(label))) for label in labels)


def meaning(label: str) -> str:
    """Of the work that a bar is labelled with."""
    return f"task {label.removeprefix(TASK)}" if label.startswith(TASK) else MEANINGS.get(label, label)
