"""The tables of the report on the robust filter; the first row of each is its heading."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from reports.erkf.counts import ALL_WAYS, PROCESSORS, TIMED, Counts, Parallel
from reports.erkf.results import Results
from reports.erkf.schedule import millions
from reports.erkf.ways import Response
from reports.pages.machine import marked, residue
from reports.pages.measurements import Shown, measurement_rows
from reports.pages.numbers import percent, plus_minus, power, raised, significant, span
from sched_sim.costs.methods import ROBUST_METHODS
from sched_sim.costs.table import CostTable
from sched_sim.design.fit import fit
from sched_sim.design.least_speed import achieved_l, least_speed
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import RobustCosts, Statistic
from sched_sim.design.timing import Timing
from sched_sim.processors.part import Part, on_part
from studies.machines.ranges import Range, range_of
from studies.robust.costs import HR_HZ, SYSTEMS, N, SystemName, parallel_costs
from studies.robust.drive import GYROS_ALONE

Rows = list[list[Any]]

WAYS = {
    "robust-inverse": "inverse",
    "robust-givens": "Givens",
    "robust-lu": "pivoted LU",
    "robust-closed": "closed form",
}
ASKED = (1, 5, 10, 20, N)
"""The L of the table."""
UNITS = (1, 4, 16, 64)
"""Column pairs at a time, of the parallel device."""
OF_POSITION = ("between_north_m", "between_east_m", "between_down_m", "outage_end_m")
"""The table's."""
SHOWN = tuple(P for P in PROCESSORS if P not in (4, 256))


Measurements = Mapping[SystemName, Sequence[CostTable]]
"""Of the same jobs, by system."""


def robust_costs_of(table: CostTable, method: str, statistic: Statistic = "minimum") -> RobustCosts[Fraction]:
    costs = select(table, method, Options(), statistic)
    assert isinstance(costs, RobustCosts)
    return costs


def cost_rows(counts: Counts, measured: Measurements) -> Rows:
    """Operations of every way, with infinite and finite mu, and the time of the compiled code."""
    rows: Rows = [["Way"]]
    for system in SYSTEMS:
        rows[0] += [f"{system}, {what}" for what in ("μ = ∞", "finite μ", marked("µs"))]
    for way in ALL_WAYS:
        row: list[Any] = [way]
        for system in SYSTEMS:
            operations = counts.operations[way]
            time = micros(measured[system], TIMED[way]) if way in TIMED else "-"
            row += [f"{operations[system, 'infinite']:,}", f"{operations[system, 'finite']:,}", time]
        rows.append(row)
    return rows


def seconds(measured: Sequence[CostTable], method: str) -> Range[float]:
    """The range of the robust step's least times."""
    return range_of(lambda table: float(table.entry(method, "robust_step").minimum), measured)


def micros(measured: Sequence[CostTable], method: str) -> str:
    """The same in words, in microseconds."""
    low, high = (f"{1e6 * time:.1f}" for time in seconds(measured, method))
    return span(low, high)


def measurement_rows_of(measured: Sequence[CostTable]) -> Rows:
    """The robust step by each measurement, in microseconds: from its least time to its 95th percentile."""

    def of(method: str) -> Shown[CostTable]:
        def ends(table: CostTable) -> str:
            step = table.entry(method, "robust_step")
            return span(f"{1e6 * float(step.minimum):.1f}", f"{1e6 * float(step.p95):.1f}")

        return ends

    return [*map(list, measurement_rows(measured, {f"{way}, µs": of(method) for method, way in WAYS.items()}))]


def by_system(tables: Mapping[SystemName, Rows]) -> Rows:
    """Tables of one heading as one, whose first column says which filter's they are."""
    (heading, *_), *_ = tables.values()
    return [["Filter", *heading], *([system, *row] for system, rows in tables.items() for row in rows[1:])]


def parallel_rows(devices: Mapping[SystemName, Parallel]) -> Rows:
    rows: Rows = [["System", "Schedule", "rotations", "stages", *(f"P = {P}" for P in SHOWN), "speed-up"]]
    for system, of_system in devices.items():
        for name, times in of_system.times.items():
            numbers = [f"{times[P]:,}" for P in SHOWN]
            gain = f"{times[PROCESSORS[0]] / times[PROCESSORS[-1]]:.0f}"
            row = [system, name, f"{of_system.rotations[name]:,}", of_system.stages[name]]
            rows.append([*row, *numbers, gain])
    return rows


def typeset(rows: Rows) -> Rows:
    """The same with powers of ten as people write them and no line that ends within what belongs together, for the
    page; files have what programs read."""
    return [[unbroken(power(str(cell))) for cell in row] for row in rows]


def unbroken(text: str) -> str:
    """With no end of a line before or behind a sign between two values."""
    return re.sub(r" ([±=/]) ", "\N{NO-BREAK SPACE}\\1\N{NO-BREAK SPACE}", text)


def agreement_rows(results: Results) -> Rows:
    """How far each way is from the inverse: at most, in a whole drive. Nothing but rounding."""
    rows: Rows = [["Filter", "Way", *map(marked, ("max, abs.", "min, abs.", "max, rel.", "min, rel.")), "fails in"]]
    names = {"givens": "Givens", "lu": "pivoted LU", "lu without pivoting": "unpivoted LU"}
    for record in results.records("agreement"):
        values = [record[key] for key in ("largest", "smallest", "relative_largest", "relative_smallest")]
        failed = record["fails_in_step"]
        shown = [residue(float(value)) if failed == "" else "-" for value in values]
        rows.append([spoken(record["case"]), names[record["way"]], *shown, f"step {failed}" if failed else "-"])
    return rows


def attitude_rows(results: Results) -> Rows:
    rows: Rows = [["Scale error", "Filter", "roll, °", "pitch, °", "yaw, °", "yaw, GPS out, °"]]
    for record in results.records("attitude"):
        values = [with_error(record, f"{name}_deg") for name in ("roll", "pitch", "yaw", "outage")]
        rows.append([f"{100 * float(record['scale_error']):g} %", spoken(record["method"]), *values])
    return rows


def position_rows(results: Results) -> Rows:
    """Of all cases but one in which only the gyros are much wrong: it is the first once more."""
    rows: Rows = [["Scale errors", "Filter", "north, m", "east, m", "up, m", "GPS out, end, m"]]
    for record in results.records("position"):
        scales = float(record["scale_error"]), float(record["accelerometer_error"])
        if scales != GYROS_ALONE:
            values = [with_error(record, name) for name in OF_POSITION]
            rows.append([" / ".join(f"{100 * of:g} %" for of in scales), spoken(record["method"]), *values])
    return rows


def differ(first: Mapping[str, str], second: Mapping[str, str], name: str) -> bool:
    """Whether two root mean squares are farther apart than twice the standard error of their difference, which is at
    most this, as both are of the same drives."""
    errors = [float(record[f"{name} se"]) for record in (first, second)]
    return abs(float(first[name]) - float(second[name])) > 2 * sum(errors)


def with_error(record: Mapping[str, str], name: str) -> str:
    """A root mean square of several drives, ± twice its standard error."""
    return plus_minus(float(record[name]), float(record[f"{name} se"]))


def spoken(method: str) -> str:
    """A filter's name of the studies as the page says it."""
    name = f"E{method}" if method.startswith("KF") else method
    name = re.sub(r"mu=1e(\d+)", lambda found: f"μ = {raised(found[1])}", name)
    signs = (("mu=inf", "μ = ∞"), ("I/mu", "I/μ"), (" x ", " × "))
    for written, said in signs:
        name = name.replace(written, said)
    return name


def response_rows(responses: Sequence[Response]) -> Rows:
    """What the lead figure draws."""
    return [
        ["System", "Way", "from fix to result, ms"],
        *([r.system, r.way, f"{1e3 * r.seconds:.3f}"] for r in responses),
    ]


def part_rows(table: CostTable, processors: Sequence[Part]) -> Rows:
    """For each processor that can time all of it, by way, the load in percent with a robust step for each fix and with
    one in each period; "no" where a deadline is missed."""
    rows: Rows = [["Processor", *WAYS.values()]]
    for part in processors:
        costs = [of_method for method in ROBUST_METHODS if (of_method := on(table, part, method)) is not None]
        if len(costs) == len(ROBUST_METHODS):
            rows.append([part.name, *(f"{_load(c, Timing(N, 0, N))} / {_load(c, Timing(1, 0, 1))}" for c in costs)])
    return rows


def _load(costs: RobustCosts[Fraction], timing: Timing) -> str:
    """In percent of the processor's time."""
    verdict = fit(costs, timing, Fraction(HR_HZ))
    return significant(100 * verdict.load) if verdict.fits else "no"


def speed_rows(tables: Mapping[SystemName, CostTable], measured: Measurements) -> Rows:
    """The least speed by L in millions of operations a second; measured: the share of a machine for L = N, over
    all measurements by their least costs. L = 1 is what the whole step in one HR period needs."""
    heads = [f"L = {L}" for L in ASKED]
    rows: Rows = [["System", "Way", *heads, marked("load, %")]]
    for system, table in tables.items():
        for method in ROBUST_METHODS:
            costs = robust_costs_of(table, method)
            speeds = [least_speed(costs, Timing(N, 0, L)).speed for L in ASKED]
            timed = (robust_costs_of(table_here, method) for table_here in measured[system])
            loads = [fit(costs_here, Timing(N, 0, N), Fraction(HR_HZ)).load for costs_here in timed]
            numbers = [f"{millions(speed, HR_HZ):#.3g}".rstrip(".") for speed in speeds]
            low, high = (significant(100 * load, 2) for load in (min(loads), max(loads)))
            rows.append([system, WAYS[method], *numbers, span(low, high)])
    return rows


def least_speed_rows(tables: Mapping[SystemName, CostTable]) -> Rows:
    """What the figure of least speeds draws, in millions of operations a second."""
    rows: Rows = [["System", "Way", "L", "million operations a second"]]
    for system, table in tables.items():
        for method in ROBUST_METHODS:
            costs = robust_costs_of(table, method)
            for L in range(1, N + 1):
                rows.append(
                    [system, WAYS[method], L, f"{millions(least_speed(costs, Timing(N, 0, L)).speed, HR_HZ):.5g}"]
                )
    return rows


def on(table: CostTable, processor: Part, method: str) -> RobustCosts[Fraction] | None:
    """In seconds; None where the processor has no time for an operation, such as a square root."""
    asked = {kind for counts in table.operations[method].values() for kind in counts} - {"function"}
    if not asked <= set(processor.seconds):
        return None
    return robust_costs_of(on_part(table, processor), method)


def processor_rows(tables: Mapping[SystemName, CostTable], processors: Sequence[Part]) -> Rows:
    """Spread over N steps, and in one HR period."""
    rows: Rows = [["System", "Processor", "Way", "fits", "load, %", "slack, %", "in use at l", "in one period, %"]]
    for system, table in tables.items():
        for part in processors:
            for method in ROBUST_METHODS:
                row: list[Any] = [system, part.name, WAYS[method]]
                costs = on(table, part, method)
                if costs is None:
                    rows.append([*row, "no sqrt", "-", "-", "-", "-"])
                    continue
                verdict = fit(costs, Timing(N, 0, N), Fraction(HR_HZ))
                serial = (costs.inertial + costs.robust_step) * HR_HZ
                row += ["yes" if verdict.fits else "no", percent(verdict.load), percent(verdict.slack)]
                rows.append([*row, "-" if verdict.landed is None else f"k+{verdict.landed}", percent(serial)])
    return rows


def device_rows(processor: Part) -> Rows:
    """Givens on a device that does several column pairs at a time, its operations as slow as the processor's."""
    rows: Rows = [["System", "units", "step, ms", "times faster", "in use at l", "clock for L = 1, MHz"]]
    for system in SYSTEMS:
        alone = None
        for units in UNITS:
            costs = on(parallel_costs(system, units), processor, "robust-givens")
            assert costs is not None
            alone = costs if alone is None else alone
            row = [system, units, *_device(costs, processor)]
            rows.append([*row[:3], f"{float(alone.robust_step / costs.robust_step):.1f}", *row[3:]])
    return rows


def _device(costs: RobustCosts[Fraction], processor: Part) -> list[Any]:
    landed = achieved_l(costs, Timing(N, 0, N), Fraction(1, HR_HZ))
    assert processor.clock_hz is not None
    clock = fit(costs, Timing(N, 0, 1), Fraction(HR_HZ)).needed * processor.clock_hz / 10**6
    return [f"{float(1000 * costs.robust_step):.3f}", "-" if landed is None else f"k+{landed}", significant(clock)]
