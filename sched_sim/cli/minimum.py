"""`sched-sim minimum`: the least processor that meets every deadline."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

from sched_sim.cli import options as opt
from sched_sim.cli.design_flags import with_options
from sched_sim.cli.instructions import (
    ClockMhz,
    CyclesEach,
    RamKb,
    board_row,
    check_ram,
    in_time_and_ram,
    instructions_note,
    part_and_costs,
    ram_words,
)
from sched_sim.cli.output import lines, print_csv, print_json, print_table
from sched_sim.cli.progress import simulations
from sched_sim.cli.refused import Refused
from sched_sim.costs.table import SECONDS, units
from sched_sim.design.options import Options
from sched_sim.rounding import no_less

LARGEST_DENOMINATOR = 10_000
"""A fraction with a larger one (of measured costs) tells a person nothing; --format json has it."""


@with_options
def minimum(
    N: opt.StepsOrNone = None,
    M: opt.Delay = None,
    L: opt.FeedbackStep = None,
    hr_hz: opt.HrHz = None,
    measurement_hz: opt.MeasurementHz = None,
    delay_ms: opt.DelayMs = None,
    land_within_ms: opt.LandWithinMs = None,
    method: opt.Methods = None,
    costs: opt.Costs = None,
    statistic: opt.WhichCost = "minimum",
    processor: opt.OnProcessor = None,
    clock_mhz: ClockMhz = None,
    cycles_per_instruction: CyclesEach = None,
    ram_kb: RamKb = None,
    options: Options = Options(),
    tasks: opt.Tasks = None,
    format: opt.Format = "table",
) -> None:
    """The least processor speed at which each method meets every deadline, and which demand fixes it; with a rate and
    costs that are times, whether it fits, and how fast the HR loop may be.

    sched-sim minimum -N 10 -M 4 -L 8
    sched-sim minimum --hr-hz 400 --measurement-hz 5 --delay-ms 110 --processor cortex-m7
    sched-sim minimum -N 40 -M 4 --hr-hz 400 --costs my-costs.toml --method dual-rate
    """
    from sched_sim.cli.caveats import caveat_note, with_caveats
    from sched_sim.cli.less_work import least_note, speed_words
    from sched_sim.cli.measured_note import measured_row, range_note, say_of_statistic
    from sched_sim.cli.parts import MEANING, fit_row, fit_words, fixed_by, highest_note, least_row
    from sched_sim.cli.uneven_note import uneven_note
    from sched_sim.cli.update_form import structure_word, update_form, update_note
    from sched_sim.costs.table import COUNTED
    from sched_sim.design.fit import fit
    from sched_sim.design.landing import landing
    from sched_sim.design.least_speed import least_speed
    from sched_sim.design.less_work import enough_for_less, holds_for_less
    from sched_sim.design.methods import select
    from sched_sim.design.pieces import converted
    from sched_sim.design.stated import Stated

    part, table = part_and_costs(costs, processor, clock_mhz, cycles_per_instruction)
    check_ram(table, ram_kb)
    rate = opt.hr_rate(hr_hz)
    others = opt.make_tasks(tasks, table.unit, rate)
    design = Stated.of(N, M, L, rate, measurement_hz, delay_ms, land_within_ms)
    timed = rate is not None and table.unit in SECONDS
    second = SECONDS.get(table.unit, Fraction(1))

    def in_seconds(cost: Fraction) -> Fraction:
        return second * cost

    names = opt.wanted_methods(method, table)
    refused = Refused(names)

    enough: dict[str, Fraction | None] = {}  # for less work too, of the methods whose least speed is not

    def found(name: str) -> tuple[dict[str, Any], dict[str, Any]]:
        """For scripts, and for people."""
        timing = design.timing(name, options)
        work = select(table, name, options, statistic)
        person: dict[str, Any] = {"method": "standard (no delay)" if name == "standard" else name}
        person |= structure_word(table)
        unit_and_form = {"cost_unit": "second" if timed else table.unit} | update_form(table, name)
        with simulations(name) as on_progress:
            if rate is not None and design.times is not None and timed:
                verdict = fit(
                    converted(work, in_seconds),
                    timing,
                    rate,
                    replace(options, context_switch=in_seconds(options.context_switch)),
                    [replace(task, cost=in_seconds(task.cost)) for task in others],
                    on_progress,
                    times=design.times,
                )
                on_it = (part, rate, design.times, verdict, bool(others))
                row = least_row(name, timing, verdict.least) | unit_and_form | fit_row(*on_it)
                person |= fit_words(*on_it) | {"fixed by": fixed_by(verdict.least.binding)}
            else:
                least = least_speed(work, timing, options, others, on_progress)
                landed = landing(work, timing, least.speed, options, others)
                assert landed is not None
                row = least_row(name, timing, least) | unit_and_form | {"achieved_l_at_min_speed": landed}
                person |= _speed(least.speed, table.unit) | {"fixed by": fixed_by(least.binding), "lands at L": landed}
                if rate is not None and design.times is not None:
                    landing_ms = design.times.landing_ms(landed, rate)
                    row |= {
                        "hr_hz": float(rate),
                        "correction_ms_at_min_speed": float(landing_ms),
                        "work_per_second": float(least.speed * rate),
                    }
                    person |= {
                        "then lands after, ms": no_less(landing_ms, 4),
                        f"{units(table.unit)} per s": f"{row['work_per_second']:.4g}",
                    }
        scale = second if timed else Fraction(1)
        speed = Fraction(row["min_speed_exact"]) / scale
        if not holds_for_less(work, timing, speed, options, others):
            enough[name] = enough_for_less(work, timing, options, others, speed)
        row = in_time_and_ram(row | board_row(table, name, ram_kb))
        return row | measured_row(table, name, timing, options, others, scale), person | ram_words(row)

    rows, shown = [], []
    for name in names:
        with refused.noting(name, design.why_none(name, options)):
            row, person = found(name)
            rows.append(row)
            shown.append(person)
    refused.say()
    say_of_statistic(statistic, [table])
    timings = {row["method"]: design.timing(row["method"], options) for row in rows}
    note = lines(
        design.words,
        uneven_note({name: (select(table, name, options, statistic), of) for name, of in timings.items()}, others),
        caveat_note(timings),
        *(
            least_note(name, speed_words(of, second * of * rate if timed and of and rate else None, table.unit))
            for name, of in enough.items()
        ),
        update_note(table, [*timings]),
        range_note(table, timings, options, others),
        instructions_note(table, rows, part),
    )
    rows = with_caveats(rows)
    if enough:
        rows = [row | {"less_work_speed": float(of) if (of := enough.get(row["method"])) else None} for row in rows]
    if format == "json":
        print_json(rows)
    elif format == "csv":
        print_csv(rows)
    elif rate is not None and timed:
        counted = "operations" if table.target is None else "instructions"
        where = f"{part.title} ({counted}: {costs or COUNTED})" if part else f"the machine of {table.name}"
        title = f"On {where}, HR loop at {float(rate):g} Hz, {design.shown}"
        print_table(title, shown, lines(MEANING, highest_note(others), note))
    else:
        unit = f"{units(table.unit)} per HR period" if part is None else f"an HR period, on {part.title}"
        print_table(f"Least speed, {design.shown}, in {unit} (costs: {table.name})", shown, note)


def _speed(speed: Fraction, unit: str) -> dict[str, str]:
    """Seconds per HR period as microseconds; the exact fraction where a person can read it."""

    if unit == "second":
        return {"least speed, us": no_less(10**6 * speed, 5)}
    exactly = str(speed) if speed.denominator <= LARGEST_DENOMINATOR else "-"
    return {"least speed": no_less(speed, 6), "exactly": exactly}
