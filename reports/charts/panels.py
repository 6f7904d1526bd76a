"""What one Gantt panel shows: a schedule, its title, and the steps k, m, l of each cycle."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from fractions import Fraction

from sched_sim.bounds import at_least_one, whole
from sched_sim.costs.methods import CAVEATS, MULTIRATE_METHODS, TWO_RATE_METHODS
from sched_sim.costs.table import INSTRUCTION, CostTable
from sched_sim.design.cycle_marks import Mark, cycle_marks
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import Statistic
from sched_sim.design.simulate import simulate, simulated_steps
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule.length import check_simulation
from sched_sim.schedule.outcome import Schedule
from sched_sim.schedule.tasks import Task
from sched_sim.ticks import Number, positive

METHOD_NAMES = {
    "standard": "Standard (no delay)",
    "recalculate": "Recalculate",
    "larsen": "Larsen",
    "dual-rate": "Dual-rate",
    "clone": "Stochastic cloning",
    "clone-split": "Stochastic cloning, split",
    "carried-gain": "Carried gain",
    "delayed-horizon": "Delayed horizon",
    "px4-predictor": "PX4 output predictor",
    "augmentation": "Augmentation",
    "fuse-as-fresh": "Fuse as fresh",
    "multirate": "Multirate gain",
    "multirate-square-root": "Multirate gain, square root",
    "multirate-ud": "Multirate gain, U-D",
    "robust-inverse": "Robust filter by explicit inverse",
    "robust-givens": "Robust filter by Givens rotations",
    "robust-lu": "Robust filter by pivoted LU",
    "robust-closed": "Robust filter in closed form",
}


MOST_STEPS, MOST_JOBS = 20_000, 100_000
"""A picture's."""
LEAST_PERCENT = 0.001
"""That is written."""


@dataclass(frozen=True)
class Panel:
    """One schedule, simulated with keep_slices=True.

    title: in bold; notes: facts behind it, such as the speed; first, last: the steps shown, by default all;
    misses: what is said of missed deadlines, by default how many the schedule has; least_bar_mm: shorter work is drawn
    so long.
    """

    title: str
    schedule: Schedule
    notes: Sequence[str] = ()
    marks: Sequence[Mark] = ()
    first: int = 0
    last: int | None = None
    misses: str = ""
    least_bar_mm: float = 0.0

    @property
    def end(self) -> int:
        """The step at whose start the panel ends."""
        return self.schedule.horizon // self.schedule.period if self.last is None else self.last


def zoomed(panel: Panel, first: int, last: int) -> Panel:
    """The steps from `first` to the start of `last`; a note says which. Raises InputError for steps it has not."""
    first, last = whole(first, "first", panel.end - 1), whole(last, "last", panel.end)
    if not 0 <= first < last:
        raise InputError(f"first is {first} and last is {last}: the first step is 0 or later, and before the last")
    return replace(panel, first=first, last=last, notes=(*panel.notes, steps_shown(first, last, panel.end)))


def steps_shown(first: int, last: int, steps: int) -> str:
    """Which of the simulated steps a panel shows, in words; the panel ends as `last` starts."""
    if first:
        return f"steps {first} to {last - 1} of {steps}"
    return f"first {last} of {steps} steps" if last < steps else f"all {steps} steps"


def landing_note(landings: Iterable[int], M: int) -> str:
    """Where the corrections landed, in words with mathtext."""
    reached = sorted(set(landings))
    if not reached:
        return "no correction lands"
    if len(reached) > 1:
        return f"lands at $l = k+{reached[0]}$ to $k+{reached[-1]}$"
    return f"lands at $l = m = k+{M}$" if reached[0] == M else f"lands at $l = k+{reached[0]}$"


def method_panel(
    table: CostTable,
    method: str,
    timing: Timing,
    speed: Number,
    cycles: int = 1,
    options: Options = Options(),
    tasks: Sequence[Task] = (),
    *,
    statistic: Statistic = "minimum",
    title: str | None = None,
    first: int = 0,
    last: int | None = None,
) -> Panel:
    """Simulate one method and say in the panel's title what came out.

    speed: cost units per HR period; cycles: how many measurement cycles are simulated; first, last: the steps shown, up
    to the start of the last one, by default all.
    Raises InputError as `methods.select` and `simulate` do, and for more steps than a chart can show.
    """
    speed, cycles = positive(speed, "speed"), at_least_one(cycles, "cycles")
    costs = select(table, method, options, statistic)
    steps = simulated_steps(costs, timing, cycles, options)
    if steps > MOST_STEPS:
        raise InputError(
            f"a Gantt chart of {cycles} cycles with N={timing.N} has {steps} steps; at most {MOST_STEPS} "
            f"can be drawn: give fewer cycles, or write a trace"
        )
    check_simulation(steps, tasks, f"{cycles} cycles of N={timing.N}", MOST_JOBS)
    landings: dict[int, int] = {}
    schedule = simulate(costs, timing, speed, cycles, options, tasks, keep_slices=True, on_landing=landings.__setitem__)
    two_rate = method in TWO_RATE_METHODS
    delay = replace(timing, M=0, instants=None) if two_rate or method == "standard" else timing
    notes = [_pace(table, speed), landing_note(landings.values(), delay.M)]
    if method == "standard":
        notes[1] = "no delay: lands at $k$"
    landing = "correction {} lands"
    if method in MULTIRATE_METHODS:
        notes[1] = notes[1].replace("correction", "gain").replace("lands at", "gain in use from")
        landing = "gain {} is in use"
    if method in CAVEATS:
        notes.append(CAVEATS[method].partition(":")[0])
    panel = Panel(
        title=METHOD_NAMES[method] if title is None else title,
        schedule=schedule,
        notes=(*notes, *_cost_notes(table), *option_notes(options), busy(schedule.utilization)),
        marks=cycle_marks(
            delay,
            cycles,
            landings,
            arrives=not two_rate,
            end=schedule.horizon // schedule.period,
            landing=landing,
        ),
    )
    if first == 0 and last is None:
        return panel
    return zoomed(panel, first, panel.end if last is None else last)


def busy(share: Fraction) -> str:
    """Of a processor, in words: whole percents, below ten of them two digits, so that little is not nothing."""
    percent = 100 * float(share)
    if 0 < percent < LEAST_PERCENT:
        return f"under {LEAST_PERCENT:g} % busy"
    return f"{percent:.0f} % busy" if percent >= 9.95 else f"{percent:.2g} % busy"


def _pace(table: CostTable, speed: Fraction) -> str:
    if table.unit == "second":
        return f"HR period {_number(1000 * speed)} ms"
    return f"speed {_number(speed)}" + (" instructions" if table.unit == INSTRUCTION else "")


def _cost_notes(table: CostTable) -> list[str]:
    """That zeros were left out, and of which core times by instructions are."""
    by_instructions = table.target is not None and table.unit != INSTRUCTION
    notes = ["sparse"] if table.structure == "sparse" else []
    return [*notes, f"by instructions of {table.target}"] if by_instructions else notes


def option_notes(options: Options) -> list[str]:
    """What differs from the paper's choices."""
    notes = []
    for choice in fields(options):
        value = getattr(options, choice.name)
        if value != choice.default:
            notes.append(choice.metadata["note"].format(_number(value) if isinstance(value, Fraction) else value))
    return notes


def _number(value: Fraction) -> str:
    """Four digits, and large numbers in full."""
    return f"{float(value):.4g}" if value < 1000 else f"{float(value):.0f}"
