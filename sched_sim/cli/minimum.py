"""`sched-sim minimum`: the least processor that meets every deadline."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from sched_sim.cli import options as opt
from sched_sim.cli.design_flags import with_options
from sched_sim.cli.output import lines, print_csv, print_json, print_table, say, units
from sched_sim.cli.progress import simulations
from sched_sim.costs.table import SECONDS
from sched_sim.design.options import Options

if TYPE_CHECKING:
    from sched_sim.design.pieces import Costs
    from sched_sim.design.timing import Timing
    from sched_sim.schedule.tasks import Task

LARGEST_DENOMINATOR = 10_000
"""A fraction with a larger one (of measured costs) tells a person nothing; --format json has it."""


@with_options
def minimum(
    N: opt.Steps,
    M: opt.Delay = None,
    L: opt.FeedbackStep = None,
    method: opt.Methods = None,
    costs: opt.Costs = None,
    statistic: opt.WhichCost = "minimum",
    processor: opt.OnProcessor = None,
    options: Options = Options(),
    tasks: opt.Tasks = None,
    hr_hz: opt.HrHz = None,
    format: opt.Format = "table",
) -> None:
    """The least processor speed at which each method meets every deadline, and which demand fixes it.

    sched-sim minimum -N 10 -M 4 -L 8
    sched-sim minimum -N 40 -M 4 --hr-hz 400 --costs my-costs.toml --method dual-rate
    sched-sim minimum -N 40 -M 20 --hr-hz 400 --processor cortex-m7
    """
    from sched_sim.cli.parts import MEANING, fit_row, fit_words, fixed_by, least_row
    from sched_sim.cli.update_form import update_form, update_note
    from sched_sim.costs.table import COUNTED
    from sched_sim.design.fit import fit
    from sched_sim.design.least_speed import least_speed
    from sched_sim.design.methods import METHODS, select

    part = opt.make_processor(processor)
    table, rate = opt.costs_on(costs, part), opt.hr_rate(hr_hz)
    others = opt.make_tasks(tasks, table.unit, rate)
    design = f"N={N} M={_given(M, 'none')} L={_given(L, 'latest')}"
    rows: list[dict[str, Any]] = []
    shown: list[dict[str, Any]] = []
    for name in opt.wanted_methods(method, table):
        timing = opt.make_timing(N, M, L, name, options)
        if not method and (reason := METHODS[name].law(options.feedback).why_none(timing.N, timing.M)):
            say(f"Note: no {name}: {reason}")
            continue
        work = select(table, name, options, statistic)
        with simulations(name) as on_progress:
            verdict = None if part is None or rate is None else fit(work, timing, rate, options, others, on_progress)
            least = least_speed(work, timing, options, others, on_progress) if verdict is None else verdict.least
        row = least_row(name, timing, least) | update_form(table, name)
        person: dict[str, Any] = {"method": "standard (no delay)" if name == "standard" else name}
        if verdict is not None and part is not None and rate is not None:
            row |= fit_row(part, rate, verdict)
            person |= fit_words(part, rate, verdict) | {"fixed by": fixed_by(least.binding)}
        else:
            landed = _landing(work, timing, least.speed, options, others)
            times = _absolute(rate, landed, least.speed, table.unit)
            row |= {"achieved_l": landed} | ({} if rate is None else {"hr_hz": float(rate)})
            row |= {key: float(value) for key, value in times.items()}
            person |= _speed(least.speed, table.unit) | {"fixed by": fixed_by(least.binding), "lands at L": landed}
            person |= dict(_in_words(key, value, table.unit) for key, value in times.items())
        rows.append(row)
        shown.append(person)
    note = update_note(table, [row["method"] for row in rows])
    if format == "json":
        print_json(rows)
    elif format == "csv":
        print_csv(rows)
    elif part is not None and rate is not None:
        title = f"{part.title}, HR loop at {float(rate):g} Hz, {design} (operations: {costs or COUNTED})"
        print_table(title, shown, lines(MEANING, note))
    else:
        unit = f"{units(table.unit)} per HR period" if part is None else f"an HR period, on {part.title}"
        print_table(f"Least speed, {design}, in {unit} (costs: {table.name})", shown, note)


def _landing(costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]) -> int:
    """The latest L at which a correction lands at the least speed."""
    from sched_sim.design.any_phase import worst_landing
    from sched_sim.design.least_speed import achieved_l, has_closed_form
    from sched_sim.schedule.tasks import phases_matter

    if phases_matter(tasks):
        landed = worst_landing(costs, timing, speed, options, tasks)
        assert landed is not None
        return landed
    if not has_closed_form(options, tasks):
        from sched_sim.design.steady import run_until_steady

        return max(run_until_steady(costs, timing, speed, options, tasks).schedule.achieved)
    landed = achieved_l(costs, timing, speed, options)
    assert landed is not None
    return landed


def _absolute(rate: Fraction | None, L: int, speed: Fraction, unit: str) -> dict[str, Fraction]:
    """What the design is in seconds: when the correction lands, the work per second the processor must do, and the
    highest rate that the processor of a table in units of time can run it at."""
    times: dict[str, Fraction] = {}
    if rate is not None:
        times |= {"correction_ms": 1000 * L / rate, "work_per_second": speed * rate * SECONDS.get(unit, 1)}
    if unit in SECONDS:
        times["highest_hr_hz"] = 1 / (speed * SECONDS[unit])
    return times


def _speed(speed: Fraction, unit: str) -> dict[str, str]:
    """Seconds per HR period as microseconds; the exact fraction where a person can read it."""
    from sched_sim.cli.parts import no_less

    if unit == "second":
        return {"least speed, us": no_less(10**6 * speed, 5)}
    exactly = str(speed) if speed.denominator <= LARGEST_DENOMINATOR else "-"
    return {"least speed": no_less(speed, 6), "exactly": exactly}


def _in_words(key: str, value: Fraction, unit: str) -> tuple[str, str]:
    """The heading of an absolute figure, and what stands below it."""
    from sched_sim.cli.parts import HIGHEST_HR_HZ, WORDS

    if key == "highest_hr_hz":
        return HIGHEST_HR_HZ, WORDS[HIGHEST_HR_HZ][1](value)
    work = "share of processor" if unit in SECONDS else f"{units(unit)} per s"
    return {"correction_ms": "lands after, ms", "work_per_second": work}[key], f"{float(value):.4g}"


def _given(value: int | None, otherwise: str) -> str:
    return otherwise if value is None else str(value)
