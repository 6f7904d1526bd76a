"""Tables of the report, as rows; the first one is the heading."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import pairwise

from reports.charts.panels import METHOD_NAMES
from reports.pages.machine import marked
from reports.pages.measurements import Shown, measurement_rows
from reports.pages.numbers import SCIENTIFIC, power
from reports.pages.stored import Rows
from reports.steffes.processors import SWITCHES, Variant, steps_of
from reports.steffes.waiting import Waited
from sched_sim.costs.methods import PAPER_METHODS
from sched_sim.costs.table import CostTable
from sched_sim.design.binding import BINDING_WORDS
from sched_sim.design.least_speed import least_speed, staircase
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import Statistic
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from studies.machines.ranges import Range, range_of
from studies.steffes import tables as steffes
from studies.steffes.agreement import Agreement
from studies.steffes.memory import Memory
from studies.steffes.noise import Approximated
from studies.steffes.products import STEPS, Multiplies

HERE = "measured for this page"
"""Heading of what the one measurement gives with which the page is made."""
P95 = "p95, at most"
"""Heading of least speeds by 95th percentiles."""
CYCLES = 4
"""That are simulated of each design."""
SMALL_DELAYS = [Timing(10, M, 8) for M in (1, 2, 3, 4)]
BY_L = Options(lr_propagate_by="l")
STAIRS = ((10, 4), (100, 10))
"""N and M of the figures of least speed and of landing."""

LARGE = r"\d{4,}"
TOGETHER = r"\d+ of \d+|\d+(, \d+)+|N, M, L|LR update, .*|Standard \(no delay\)"
PHRASE = r"(one|two) CPUs?|early gain|one LR|\b\w [+−] \d\b"
NO_BREAK = "\N{NO-BREAK SPACE}"


def number(value: Fraction | float, digits: int = 3) -> str:
    return f"{float(value):.{digits}f}"


def least(
    table: CostTable, method: str, timing: Timing, options: Options = Options(), statistic: Statistic = "minimum"
) -> Fraction:
    return least_speed(select(table, method, options, statistic), timing, options).speed


def span(low: Fraction | float, high: Fraction | float) -> str:
    """One number where they are the same."""
    return number(low) if low == high else f"{number(low)} to {number(high)}"


def design(timing: Timing) -> str:
    return f"{timing.N}, {timing.M}, {timing.L}"


def over(measured: Sequence[CostTable], method: str, timing: Timing) -> Range[Fraction]:
    """The least speed by the least costs of each measurement."""
    return range_of(lambda table: least(table, method, timing), measured)


def at_p95(measured: Sequence[CostTable], method: str, timing: Timing) -> Fraction:
    """The greatest least speed by the 95th percentiles of each measurement."""
    return range_of(lambda table: least(table, method, timing, statistic="p95"), measured).high


def entries(counted: CostTable, measured: Sequence[CostTable]) -> Rows:
    """measured: each normalised."""
    rows: Rows = [["Table", "Step", "Work", "printed", "counted", marked("measured")]]
    for entry in steffes.entries():
        values = [number(entry.value(counted)), span(*range_of(entry.value, measured))]
        step = entry.step.replace("m-1", "m − 1").replace("..", "to").replace("+", " + ")
        rows.append([entry.table, step, entry.column, number(entry.printed, 2), *values])
    return rows


def table4(counted: CostTable, measured: Sequence[CostTable], here: CostTable, cells: Sequence[steffes.Cell]) -> Rows:
    """measured: each normalised; here: the one with which the page is made."""
    heading = ["N, M, L", "Method", "printed", "analysis", "exactly", "from rounding", "reached", "counted"]
    rows: Rows = [[*heading, marked("measured"), marked(HERE), marked(P95)]]
    for cell in cells:
        of_cell = cell.method, cell.timing
        by_counts, by_this = (number(least(table, *of_cell)) for table in (counted, here))
        others = [by_counts, span(*over(measured, *of_cell)), by_this, number(at_p95(measured, *of_cell))]
        rows.append(
            [
                *(design(cell.timing), METHOD_NAMES[cell.method], number(cell.printed, 2), number(cell.computed.speed)),
                *(str(cell.computed.speed), span(cell.lowest, cell.highest), "yes" if cell.reached else "no", *others),
            ]
        )
    return rows


def measurements(measured: Sequence[CostTable], timing: Timing) -> Rows:
    """What each measurement gives: the deviation from Tables 1 to 3, and least speeds of a design. measured: each
    normalised."""

    def of(method: str) -> Shown[CostTable]:
        return lambda table: number(least(table, method, timing))

    speeds = {METHOD_NAMES[method]: of(method) for method in PAPER_METHODS if method != "standard"}
    return measurement_rows(measured, {"deviation": lambda table: number(steffes.deviation(table)), **speeds})


def without(rows: Rows, *headings: str) -> Rows:
    """The same without these columns, so that it fits a page."""
    kept = [column for column, heading in enumerate(rows[0]) if heading not in headings]
    return [[row[column] for column in kept] for row in rows]


def simulated(paper: CostTable) -> Rows:
    """Each design at its least speed, and one tick of the period slower; misses are of all jobs released."""
    heading = ["N, M, L", "Method", "least speed", "fixed by", "misses", "lands at L", "busy, %"]
    rows: Rows = [[*heading, "misses, slower"]]
    for timing in steffes.cases():
        for method in PAPER_METHODS:
            costs = select(paper, method, Options())
            found = least_speed(costs, timing)
            schedule = simulate(costs, timing, found.speed, CYCLES)
            slower = simulate(costs, timing, found.speed - found.speed / schedule.period, CYCLES)
            (landed,) = schedule.achieved
            misses = [
                f"{of.misses} of {sum(kind.releases for kind in of.responses.values())}" for of in (schedule, slower)
            ]
            rows.append(
                [
                    *(
                        design(timing),
                        METHOD_NAMES[method],
                        number(found.speed),
                        BINDING_WORDS[found.binding],
                        misses[0],
                    ),
                    *(landed, f"{100 * float(schedule.utilization):.0f}", misses[1]),
                ]
            )
    return rows


def propagate_by(paper: CostTable) -> Rows:
    rows: Rows = [["N, M, L", "least speed, by m", "by l"]]
    for timing in SMALL_DELAYS:
        both = [number(least(paper, "dual-rate", timing, options), 4) for options in (Options(), BY_L)]
        rows.append([design(timing), *both])
    return rows


def stairs(paper: CostTable) -> Rows:
    """Least speed by L, and where the correction lands at it."""
    rows: Rows = [["N", "M", "Method", "L", "least speed", "lands at L"]]
    for N, M in STAIRS:
        for method in PAPER_METHODS:
            for stair in staircase(select(paper, method), N, M):
                rows.append([N, M, METHOD_NAMES[method], stair.L, number(stair.speed, 4), stair.achieved])
    return rows


def agreement(found: Agreement) -> Rows:
    """By step: how far the states are from those of the dual-rate filter, and P where there is a measurement."""
    N, methods = found.timing.N, list(found.state)
    rows: Rows = [["step", "m to l − 1", *(f"{METHOD_NAMES[of]}, {what}" for what in ("state", "P") for of in methods)]]
    for j, waiting in enumerate(found.waiting.tolist()):
        states = [f"{found.state[method][j]:.2e}" for method in methods]
        covariances = ["" if j % N else f"{found.covariance[method][j // N]:.2e}" for method in methods]
        rows.append([j, "yes" if waiting else "no", *states, *covariances])
    return rows


def products(counted: Sequence[Multiplies]) -> Rows:
    rows: Rows = [["n", "n³", *STEPS.values(), "over standard", "saved by Q′"]]
    exact, summed = ("dual-rate", "hr_propagate"), ("dual-rate", "hr_propagate_sum")
    for one in counted:
        saved = one.by_job[exact] - one.by_job[summed]
        rows.append([one.n, one.n**3, *one.by_job.values(), one.more(exact), saved])
    return rows


def memory(found: Sequence[Memory]) -> Rows:
    rows: Rows = [["Method", "x", "P", "Φ", "Q", "n × n kept", "z, K, δx", "scratch", "numbers in all"]]
    for one in found:
        rows.append(
            [
                METHOD_NAMES[one.method],
                one.states,
                one.P,
                one.Phi,
                one.Q,
                one.matrices,
                one.correction,
                one.scratch,
                one.total,
            ]
        )
    return rows


def waiting(found: Sequence[Waited]) -> Rows:
    rows: Rows = [["N", "M", "L", "L − M", "least speed"]]
    for one in found:
        rows.append([one.timing.N, one.timing.M, one.timing.L, one.waits, number(one.speed, 4)])
    return rows


def processors(found: Sequence[Variant]) -> Rows:
    rows: Rows = [["Dual-rate on", "least speed", "lands there at L", "at the speed of one CPU, at L"]]
    for one in found:
        rows.append([one.name, number(one.speed), one.lands, one.beside])
    return rows


def landings(landed: Mapping[str, Sequence[tuple[float, int]]]) -> Rows:
    """From which speed on each variant lands where."""
    rows: Rows = [["Dual-rate on", "from speed", "lands at L"]]
    for name, curve in landed.items():
        rows += [[name, number(speed), L] for speed, L in steps_of(curve)]
    return rows


def switches(speeds: Mapping[str, Sequence[Fraction]]) -> Rows:
    rows: Rows = [["context switch", *(METHOD_NAMES[method] for method in speeds)]]
    for cost, *of in zip(SWITCHES, *speeds.values(), strict=True):
        rows.append([number(cost, 2), *(number(speed, 3) for speed in of)])
    return rows


def noise(found: Sequence[Approximated]) -> Rows:
    """Of each system and share of Q, both approximations side by side."""
    rows: Rows = [["System", "share of Q in P", "P wrong, Q′", "P wrong, Q″", "σ larger, Q′", "σ larger, Q″"]]
    pairs = [(one, other) for one, other in pairwise(found) if (one.noise, other.noise) == ("sum", "euler")]
    for summed, euler in pairs:
        values = summed.share, summed.covariance, euler.covariance, summed.estimate, euler.estimate
        rows.append([summed.system, *(f"{value:#.2g}" for value in values)])
    return rows


def on_page(rows: Rows) -> Rows:
    """The same as people write them: small numbers as powers of ten, commas between thousands, and no line ends within
    what belongs together."""
    return [[_whole(str(cell)) for cell in row] for row in rows]


def _whole(cell: str) -> str:
    if re.fullmatch(LARGE, cell):
        return f"{int(cell):,}"
    if SCIENTIFIC.fullmatch(cell):
        return power(cell)
    return cell.replace(" ", NO_BREAK) if re.fullmatch(TOGETHER, cell) else re.sub(PHRASE, _unbroken, cell)


def _unbroken(phrase: re.Match[str]) -> str:
    return phrase[0].replace(" ", NO_BREAK)
