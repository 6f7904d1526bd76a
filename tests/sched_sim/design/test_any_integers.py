"""The closed form on any integers: as large as they come, one design or arrays of any shape, never overflowing
silently."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.design import analysis
from sched_sim.design.analysis import achieved_l, least_period
from sched_sim.design.binding import Binding
from sched_sim.design.demand import NOT_LANDED
from sched_sim.design.methods import METHODS
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts, JobCosts, LarsenCosts, RecalculateCosts, StandardCosts, works
from sched_sim.design.timing import Feedback
from sched_sim.errors import InputError
from studies.sweep.legal import Legal
from tests.command_line import Run
from tests.designs import Design, designs

COSTS = DualRateCosts(hr=60, hr_restart=10, hr_update=5, lr_propagate=30, lr_gain=0, lr_update=50)

factors = st.integers(1, 60).map(lambda digits: 10**digits) | st.integers(40, 70).map(lambda bits: 2**bits)


def times(costs: JobCosts, factor: int) -> JobCosts:
    return type(costs)(*(factor * cost for cost in works(costs)))


@given(designs, factors, st.sampled_from([np.int32, np.int64, np.uint64, object]))
def test_costs_times_a_factor_need_that_much_longer_periods_and_land_where_they_did(
    design: Design, factor: int, dtype: Any
) -> None:
    N, M, L = (np.array([step], dtype) for step in (design.timing.N, design.timing.M, design.timing.L))
    small, large = (least_period(times(design.costs, by), N, M, L, design.options) for by in (1, factor))
    (numerator,), (denominator,), (code,) = (part.tolist() for part in large)
    assert Fraction(numerator, denominator) == factor * Fraction(small.numerator.item(), small.denominator.item())
    assert code == small.code.item()
    period = -(-small.numerator // small.denominator)
    landed = achieved_l(design.costs, N, M, period, design.options)
    assert achieved_l(times(design.costs, factor), N, M, factor * period.astype(object), design.options) == landed


@given(designs, factors, st.just(1) | factors, st.fractions(0, 3))
def test_one_design_in_plain_integers_is_what_it_is_in_arrays(
    design: Design, factor: int, longer: int, share: Fraction
) -> None:
    costs, timing, options = times(design.costs, factor), design.timing, design.options
    walks = options.feedback == "same-step"  # over all steps, from L down
    N, M, L = ((1 if walks else longer) * step for step in (timing.N, timing.M, timing.L))
    one, several = least_period(costs, N, M, L, options), least_period(costs, *map(arrays, (N, M, L)), options)
    assert [{part} for part in one] == [{*whole.tolist()} for whole in several]
    assert {*map(type, one)} <= {int, Binding}
    least = -(-one.numerator // one.denominator)
    for period in (least - 1, least, int(share * least)):
        landed = achieved_l(costs, N, M, period, options)
        assert type(landed) is int
        assert {landed} == {*achieved_l(costs, *map(arrays, (N, M, period)), options).tolist()}


@pytest.mark.parametrize("feedback", ["next-step", "same-step"])
@pytest.mark.parametrize("cpus", [1, 2])
def test_compiled_it_is_what_it_is_in_pythons_integers(
    monkeypatch: pytest.MonkeyPatch, feedback: Feedback, cpus: Literal[1, 2]
) -> None:
    """Up to numbers that just do not overflow."""
    random = np.random.default_rng(cpus)
    N = random.integers(1, 60, 2000)
    M = random.integers(0, N)
    L, scale = random.integers(M, N) + (feedback == "next-step"), random.integers(1, 60, 2000)
    for largest in (3, 100, 10**8, 10**11):
        costs = DualRateCosts(*random.integers(0, largest, 6).tolist())
        for options in (Options(feedback=feedback, cpus=cpus, lr_propagate_by=by) for by in ("m", "l")):
            monkeypatch.setattr(analysis, "COMPILED_FROM", 1)
            least = least_period(costs, N, M, L, options)
            periods = least.numerator * scale // least.denominator + random.integers(-1, 2, 2000)
            landed = achieved_l(costs, N, M, periods, options, scale)
            assert {part.dtype for part in (*least, landed)} == {np.dtype(np.int64)}
            monkeypatch.setattr(analysis, "COMPILED_FROM", 10**6)
            for found, expected in zip(least, least_period(costs, N, M, L, options), strict=True):
                np.testing.assert_array_equal(found, expected)
            np.testing.assert_array_equal(landed, achieved_l(costs, N, M, periods, options, scale))


@given(designs, st.fractions(0, 3), st.integers(1, 50))
def test_a_period_may_be_so_much_over_a_scale(design: Design, share: Fraction, scale: int) -> None:
    """As where all costs are so many times as large."""
    N, M, L = design.timing.N, design.timing.M, design.timing.L
    least = least_period(design.costs, N, M, L, design.options)
    period = int(share * scale * least.numerator / least.denominator) + 1
    landed = achieved_l(design.costs, N, M, period, design.options, scale)
    assert landed == achieved_l(times(design.costs, scale), N, M, period, design.options)
    assert [landed] == achieved_l(
        design.costs, *(np.array([number]) for number in (N, M, period)), design.options, scale
    ).tolist()


def arrays(number: int) -> Any:
    return np.array([number, number], dtype=object)


@pytest.mark.parametrize("largest", [2**31 - 1, 2**62, 2**63 - 1, 10**30])
def test_steps_near_the_limits_of_an_integer_type(largest: int) -> None:
    """By hand: LR propagate by m takes the HR work of steps k .. m-1 and itself, in M steps."""
    N, M = np.array([largest] * 2), np.array([largest // 2, 1])
    least = least_period(COSTS, N, M, N, Options())
    many = Fraction(COSTS.hr * (largest // 2 - 1) + COSTS.hr_restart + COSTS.lr_propagate, largest // 2)
    assert [*map(Fraction, least.numerator.tolist(), least.denominator.tolist())] == [
        max(Fraction(COSTS.hr + COSTS.hr_update), many),
        Fraction(COSTS.hr + COSTS.lr_propagate),
    ]
    assert least_period(LarsenCosts(3, 4, 5), N, M, N, Options()).numerator.tolist() == [9, 8]
    replayed = least_period(RecalculateCosts(3, 5, 2), N, M, N, Options())
    assert replayed.numerator.tolist() == [8 + 2 * m for m in M.tolist()]


@pytest.mark.parametrize("N", [100, 2**41, 2**62])
def test_hr_jobs_that_leave_nothing_never_land_however_long_the_cycle(N: int) -> None:
    (steps,) = np.array([[N]])
    assert achieved_l(COSTS, steps, 4 + 0 * steps, COSTS.hr + 0 * steps, Options()).item() == NOT_LANDED
    same_step = Options(feedback="same-step")
    assert achieved_l(COSTS, steps, 4 + 0 * steps, COSTS.hr + 0 * steps, same_step).item() == NOT_LANDED


@pytest.mark.parametrize("feedback", ["next-step", "same-step"])
@pytest.mark.parametrize("cpus", [1, 2])
def test_arrays_keep_their_shape(feedback: Any, cpus: Any) -> None:
    N = np.array([[10, 10, 100], [8, 9, 12]])
    M, L = N // 3, N // 2
    options = Options(feedback=feedback, cpus=cpus)
    whole, flat = (least_period(COSTS, *axes, options) for axes in ((N, M, L), (N.ravel(), M.ravel(), L.ravel())))
    assert whole.numerator.shape == whole.denominator.shape == whole.code.shape == N.shape
    assert all((part.ravel() == other).all() for part, other in zip(whole, flat, strict=True))
    landed = achieved_l(COSTS, N, M, 90 + 0 * N, options)
    assert landed.shape == N.shape
    assert (landed.ravel() == achieved_l(COSTS, N.ravel(), M.ravel(), 90 + 0 * N.ravel(), options)).all()


def test_no_point_is_no_point() -> None:
    none = np.array([], dtype=np.int64)
    assert least_period(COSTS, none, none, none, Options(feedback="same-step")).numerator.size == 0


@pytest.mark.parametrize(
    ("costs", "N"),
    [
        (COSTS, np.array([10.0])),
        (COSTS, np.array([Fraction(21, 2)], dtype=object)),
        (StandardCosts(Fraction(1, 2), 1), np.array([10])),
        (StandardCosts(Fraction(1, 2), 1), 10),
    ],
)
def test_what_is_no_whole_number_is_refused(costs: JobCosts, N: Any) -> None:
    with pytest.raises(TypeError, match="integer"):
        least_period(costs, N, np.array([4]), np.array([8]), Options())


@pytest.mark.parametrize("steps", [(10.0, 4, 8), (10, 4.0, 8), (10, 4, Fraction(17, 2))])
def test_steps_of_one_design_that_are_no_whole_numbers_are_refused(steps: Any) -> None:
    with pytest.raises(TypeError, match="integer"):
        least_period(COSTS, *steps, Options())


@pytest.mark.parametrize(
    ("N", "M", "L", "said"),
    [
        ([10**10], None, None, "N=10000000000 with every M from 0 to N is too many"),
        ([10**18, 10**18 + 1, 10**18 + 2], [4], None, r"up to 3e\+18 designs is too large"),
        ([9 * 10**18], [4], [8], "9000000000000000000 steps are too many"),
        ([10], [99 * 10**18], [8], "99000000000000000000 steps are too many"),
    ],
)
def test_a_grid_of_more_designs_than_can_be_counted_is_refused(
    N: list[int], M: list[int] | None, L: list[int] | None, said: str
) -> None:
    with pytest.raises(InputError, match=said):
        Legal(METHODS["dual-rate"].law("next-step"), N, M, L)


TABLE = """
name = "measured"
unit = "us"

[costs.dual-rate]
hr_propagate = 45.123456789012345
hr_restart = 0.0021234567890123457
hr_update = 12.397596782782849
lr_propagate = 30.123456789012345
lr_update = 40.123456789012345
"""
"""With all 17 digits of a float: in whole ticks, they need more than 64 bits."""


@pytest.mark.parametrize(
    "line", ["minimum -N 10 -M 4 -L 8", "simulate -N 10 -M 4 -L 8", "gantt -N 10 -M 4 -o x.svg", "sweep -N 4:6"]
)
def test_a_cost_of_17_digits_goes_through_every_command(sched_sim: Run, tmp_path: Path, line: str) -> None:
    (tmp_path / "mine.toml").write_text(TABLE)
    assert sched_sim(f"{line} --method dual-rate --costs mine.toml").code == 0


def test_its_least_speed_is_exact_to_the_last_digit(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(TABLE)
    shown = sched_sim("minimum -N 10 -M 4 -L 8 --method dual-rate --costs mine.toml --format json").out
    one_hr_job = Fraction("45.123456789012345") + Fraction("12.397596782782849")
    assert f'"{one_hr_job}"' in shown


def test_one_long_design_with_same_step_feedback_is_what_it_is_in_arrays() -> None:
    """The step in which the LR update finishes is hundreds before the last that is allowed."""
    costs = DualRateCosts(hr=60, hr_restart=10, hr_update=5, lr_propagate=4000, lr_gain=0, lr_update=700)
    for factor in (1, 2**70):
        for M, L in ((3, 990), (200, 201), (0, 999)):
            one = least_period(times(costs, factor), 1000, M, L, Options(feedback="same-step"))
            several = least_period(times(costs, factor), *map(arrays, (1000, M, L)), Options(feedback="same-step"))
            assert [{part} for part in one] == [{*whole.tolist()} for whole in several]
