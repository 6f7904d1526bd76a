"""The rows of a sweep against the scalar functions, one design at a time."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.costs.methods import KINDS, METHODS
from sched_sim.costs.table import Cost, CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import achieved_l, least_speed
from sched_sim.design.options import Options
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule.tasks import Task
from studies.sweep.grid import Grid
from studies.sweep.rows import columns, rows_of
from studies.sweep.simulated import simulated

CYCLES = 4

ANALYSED = [column.name for column in columns(simulated=False)]
SIMULATED = [column.name for column in columns(simulated=True)]

# Digits of a measured cost, in ticks far beyond 64 bits, and of a printed one.
DIGITS = st.sampled_from([2, 17])


@st.composite
def tables(draw):
    places = draw(DIGITS)
    cost = st.decimals("0.01", "1", places=places).map(Fraction).map(Cost.of)
    return CostTable("drawn", "unit", {method: {kind: draw(cost) for kind in kinds} for method, kinds in KINDS.items()})


OPTIONS = st.builds(
    Options,
    feedback=st.sampled_from(["next-step", "same-step"]),
    lr_propagate_by=st.sampled_from(["m", "l"]),
    gain=st.sampled_from(["at-update", "precomputed"]),
    low_rate_noise=st.sampled_from(["exact", "sum", "euler"]),
    cpus=st.sampled_from([1, 2]),
)
SPEEDS = st.lists(st.decimals("0.1", "3", places=2).map(Fraction), max_size=3, unique=True).map(sorted).map(tuple)


def points(grid):
    """(timing, speed or None) and the block of each point."""
    for span in grid.spans(range(grid.size), lambda _: 50):
        chunk = grid.chunk(span.start, span.stop)
        for position in chunk.positions:
            design, at = divmod(position, max(len(grid.speeds), 1))
            timing = Timing(*(int(values[design]) for values in chunk.designs))
            yield chunk.block, timing, grid.speeds[at] if grid.speeds else None


def rows(grid, cycles=None):
    names = ANALYSED if cycles is None else SIMULATED
    for span in grid.spans(range(grid.size), lambda _: 50):
        for row in rows_of(grid.chunk(span.start, span.stop), cycles):
            yield dict(zip(names, row, strict=True))


@given(tables(), st.sampled_from(METHODS), OPTIONS, SPEEDS, st.integers(1, 7))
def test_rows_are_those_of_the_scalar_analysis_and_of_the_simulation(table, method, options, speeds, N):
    grid = Grid((N,), None, None, speeds, (method,), (table,), (options,))
    found = list(rows(grid, CYCLES))
    assert [row["point"] for row in found] == list(range(grid.size))
    for row, (block, timing, speed) in zip(found, points(grid), strict=True):
        least = least_speed(block.costs, timing, options)
        speed = least.speed if speed is None else speed
        schedule = simulate(block.costs, timing, speed, CYCLES, options)
        assert (row["N"], row["M"], row["L"]) == (timing.N, timing.M, timing.L)
        assert row["speed"] == float(speed)
        assert (row["min_speed"], row["min_speed_exact"], row["binding"]) == (
            float(least.speed),
            str(least.speed),
            least.binding,
        )
        assert row["achieved_l"] == achieved_l(block.costs, timing, speed, options)
        assert row["feasible"] == (schedule.misses == 0)
        assert row["misses"] == schedule.misses
        assert row["landed"] == sum(schedule.achieved.values())
        if row["feasible"]:
            assert row["landed"] == CYCLES
            assert row["achieved_l_max"] == row["achieved_l"]
        assert row["achieved_l_min"] == min(schedule.achieved, default=None)
        assert row["achieved_l_max"] == max(schedule.achieved, default=None)
        assert row["utilization"] == float(schedule.utilization)
        assert row["preemptions"] == schedule.preemptions
        hr = schedule.responses["hr"]
        assert row["hr_response"] == (float(Fraction(hr.worst, schedule.period)) if hr.finished else None)
        assert (row["lr_update_response"] is None) == (
            "lr_update" not in schedule.responses or not schedule.responses["lr_update"].finished
        )


def steffes(N, M, L, method="dual-rate", speeds=(), **options):
    grid = Grid((N,), (M,), L and (L,), speeds, (method,), (load_costs("steffes2014"),), (Options(**options),))
    return list(rows(grid, 3))


def test_figures_of_the_paper():
    (row,) = steffes(10, 4, 8)
    assert (row["min_speed_exact"], row["binding"], row["feasible"], row["misses"]) == ("77/100", "lr_update", True, 0)
    (row,) = steffes(100, 10, 80)
    assert (row["min_speed_exact"], row["binding"], row["achieved_l"]) == ("33/50", "hr", 29)
    (row,) = steffes(10, 4, 8, "larsen")
    assert (row["min_speed_exact"], row["achieved_l"]) == ("147/100", 4)


def test_too_slow_a_processor_lands_nowhere():
    (row,) = steffes(10, 4, 8, speeds=(Fraction(1, 2),))
    assert (row["feasible"], row["achieved_l"], row["landed"]) == (False, None, 0)
    assert row["misses"] > 0
    assert row["lr_update_response"] is None


CONTROL = Task("control", Fraction(2), Fraction(1, 10), 5, Fraction(1, 2), jitter=Fraction(1, 4))
TELEMETRY = Task("telemetry", Fraction(5), Fraction(1, 5), 30, preemptive=False)


def plain(method):
    """Costs in tenths of a unit."""
    return {kind: Cost.of(Fraction(place + 3, 10)) for place, kind in enumerate(KINDS[method])}


@pytest.mark.parametrize(
    ("methods", "tasks", "options"),
    [
        (METHODS, (), Options()),
        (("dual-rate", "delayed-horizon"), (CONTROL,), Options(cpus=2)),
        (("dual-rate",), (CONTROL, TELEMETRY), Options(feedback="same-step")),
        (("larsen",), (TELEMETRY,), Options(policy="edf", context_switch=Fraction(1, 100))),
    ],
)
def test_simulated_figures_are_the_same_by_either_engine(methods, tasks, options):
    table = CostTable("plain", "unit", {method: plain(method) for method in METHODS})
    grid = Grid((1, 2, 5), None, None, (Fraction(1),), methods, (table,), (options,), tasks=tasks)
    for block, timing, _ in points(grid):
        at = [(timing, Fraction(*speed)) for speed in ((7, 10), (6, 5), (4, 1))]
        assert repr(simulated(block, at, CYCLES, "compiled")) == repr(simulated(block, at, CYCLES, "simpy"))


def test_simpy_takes_the_points_that_64_bits_do_not_hold():
    (row,) = steffes(10, 4, 8)
    fine = [Fraction(77, 100), Fraction(77 * 10**18 + 1, 10**20)]
    grid = Grid((10,), (4,), (8,), tuple(fine), ("dual-rate",), (load_costs("steffes2014"),), (Options(),))
    by_both, by_simpy = (rows_of(grid.chunk(0, 2), 3, engine) for engine in ("auto", "simpy"))
    assert repr(by_both) == repr(by_simpy)
    assert by_both[0][5:] == tuple(row.values())[5:]
    with pytest.raises(InputError, match="do not fit into 64 bits; give engine simpy"):
        rows_of(grid.chunk(0, 2), 3, "compiled")


@pytest.mark.parametrize("method", ["dual-rate", "recalculate"])
def test_context_switches_go_through_the_simulation(method):
    switch = Fraction(1, 100)
    found = steffes(6, 2, None, method, speeds=(), context_switch=switch)
    for row in found:
        from sched_sim.design.methods import select

        options = Options(context_switch=switch)
        costs = select(load_costs("steffes2014"), method, options)
        least = least_speed(costs, Timing(row["N"], row["M"], row["L"]), options)
        assert (row["min_speed_exact"], row["binding"]) == (str(least.speed), least.binding)
        assert row["feasible"]
        assert row["misses"] == 0
        assert row["achieved_l_min"] <= row["achieved_l"] <= row["L"]
    (slow,) = steffes(6, 2, 4, method, speeds=(Fraction(1, 2),), context_switch=switch)
    assert (slow["feasible"], slow["achieved_l"]) == (False, None)


@pytest.mark.parametrize("method", ["recalculate", "larsen", "clone", "dual-rate"])
@pytest.mark.parametrize("L", [None, (4, 9)])
def test_rows_of_several_in_flight(method, L):
    table = load_costs("counted-9-3-3")
    (slow,) = (least_speed(block.costs, Timing(3, 4, 6)).speed for block in blocks(method, table))
    for speeds in ((), (slow, 2 * slow)):
        grid = Grid((3, 5), (2, 4), L, speeds, (method,), (table,), (Options(),))
        found = list(rows(grid, CYCLES))
        assert any(row["M"] > row["N"] for row in found)
        for row, (block, timing, speed) in zip(found, points(grid), strict=True):
            least = least_speed(block.costs, timing)
            assert (row["min_speed_exact"], row["binding"]) == (str(least.speed), least.binding)
            at = least.speed if speed is None else speed
            if at >= least.speed:
                assert row["feasible"]
                assert row["misses"] == 0
                assert row["achieved_l"] == achieved_l(block.costs, timing, at) <= max(timing.L, timing.M)
            assert row["landed"] <= CYCLES


def blocks(method, table):
    return Grid((3,), (2,), None, (), (method,), (table,), (Options(),)).blocks
