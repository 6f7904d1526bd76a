"""Fixed priorities and earliest deadline first: by hand, and the law between them."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim.design.least_speed import least_speed
from sched_sim.design.options import Options
from sched_sim.design.pieces import LarsenCosts, RecalculateCosts, SerialCosts, StandardCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task
from tests.command_line import Run

EDF = Options(policy="edf")
HALF = StandardCosts(Fraction(1, 4), Fraction(1, 4))
CONTROL = Task("control", Fraction(5, 2), Fraction(5, 4), 20, offset=Fraction(0))
"""Beside a step that takes half a period, it fills the processor."""


def test_by_deadlines_a_processor_that_is_full_misses_nothing() -> None:
    """By priorities the task is left 1 in its 2.5 periods, for each step goes first."""
    timing = Timing(1, 0, 0)
    assert least_speed(HALF, timing, EDF, [CONTROL]).speed == 1
    assert least_speed(HALF, timing, Options(), [CONTROL]).speed > 1
    assert simulate(HALF, timing, Fraction(1), 10, EDF, [CONTROL]).misses == 0
    assert simulate(HALF, timing, Fraction(1), 10, Options(), [CONTROL]).misses > 0


def test_of_equal_deadlines_the_job_released_first_runs() -> None:
    """The step from 2 and the task from 0 end at 3: the task, released first, is not preempted."""
    task = Task("control", Fraction(3), Fraction(2), 20, offset=Fraction(0))
    schedule = simulate(HALF, Timing(1, 0, 0), Fraction(1), 3, EDF, [task], keep_slices=True)
    assert [(piece.kind, piece.start, piece.end) for piece in schedule.slices if piece.kind != "hr"] == [
        ("task:control", 2, 4),
        ("task:control", 6, 12),
    ]


work = st.integers(1, 12).map(lambda tenths: Fraction(tenths, 10))


@st.composite
def serial(draw: st.DrawFn) -> tuple[SerialCosts[Fraction], Timing]:
    propagate, update, more = draw(work), draw(work), draw(work)
    costs = draw(
        st.sampled_from(
            [
                StandardCosts(propagate, update),
                RecalculateCosts(propagate, update, more),
                LarsenCosts(propagate, propagate + more, update),
            ]
        )
    )
    N = draw(st.integers(1, 6))
    M = draw(st.integers(0, N))
    return costs, Timing(N, M, M)


@st.composite
def tasks(draw: st.DrawFn) -> list[Task]:
    period = st.sampled_from([Fraction(1, 2), Fraction(1), Fraction(3, 2), Fraction(2), Fraction(3), Fraction(4)])
    offset, priority = st.sampled_from([Fraction(0), Fraction(1, 2), Fraction(1)]), st.sampled_from([5, 10, 15, 20])
    return [
        Task(f"t{number}", draw(period), draw(work), draw(priority), draw(offset))
        for number in range(draw(st.integers(0, 3)))
    ]


@settings(max_examples=15)
@given(serial(), tasks())
def test_it_never_needs_a_faster_processor_where_deadlines_are_the_jobs_own(
    design: tuple[SerialCosts[Fraction], Timing], beside: list[Task]
) -> None:
    """Liu and Layland (1973), Theorem 7, and the optimality of earliest deadline first on one processor (Dertouzos,
    1974): what any order of the same jobs meets, it meets."""
    assert least_speed(*design, EDF, beside).speed <= least_speed(*design, Options(), beside).speed


def test_commands_and_sweeps_take_it(sched_sim: Run) -> None:
    assert sched_sim("minimum -N 10 -M 4 --policy edf").code == 0
    result = sched_sim("sweep -N 4 -M 1 --method larsen --policy fixed,edf --format csv --export rows.csv")
    assert result.code == 0, result.err
    assert "choose from fixed, edf" in sched_sim("sweep -N 4 --policy rate").err
