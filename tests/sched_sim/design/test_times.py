"""Hertz and milliseconds in steps, and the highest rate at which they still hold."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim.costs.table_file import load_costs
from sched_sim.design.fit import fit
from sched_sim.design.highest_rate import highest_rate
from sched_sim.design.landing import landing
from sched_sim.design.methods import METHODS, select
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs
from sched_sim.design.times import Instants, Times
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part
from sched_sim.scenario.instants import roundings
from sched_sim.schedule.tasks import Task

rates = st.fractions(Fraction(1, 10), 1000, max_denominator=50)


def on_cortex_m4f(method: str) -> Costs:
    return select(on_part(load_costs("counted-9-3-3"), load_part("cortex-m4f")), method)


def test_what_divides_is_exact() -> None:
    assert Timing.at(400, 5, 110, 150) == Timing(80, 44, 60)
    assert Timing.at(400, 5, 110) == Timing(80, 44, 80)
    assert Timing.at("1000/3", "10/3") == Timing(100, 0, 100)


def test_several_may_be_on_their_way() -> None:
    assert Timing.at(400, 5, 300) == Timing(80, 120, 160)
    instants = Instants(Fraction(40, 3), Fraction("13.32"))
    assert Timing.at(400, 30, "33.3") == Timing(13, 14, 26, instants)
    assert Timing.at(400, 30, 20) == Timing(13, 8, 13, instants) == Timing(13, 8, 13)
    assert Timing.at(400, 5, 110, 300) == Timing(80, 44, 120)


def test_what_does_not_is_rounded_to_the_safe_side_and_said() -> None:
    times = Times.of(30, 12.2, 29.9)
    assert times.steps(Fraction(400)) == (13, 5, 11)
    assert list(times.words(Fraction(400))) == [
        "30 Hz: N = 13 steps, the shorter of the intervals of 13 and 14 between measurements; each is taken up to "
        "1.66667 ms before its step k, and landings in ms are from then",
        "12.2 ms late: M = 5 steps, used in the first step after: 12.5 ms",
        "lands within 29.9 ms: L = 11 steps, the last one by then: 29.1667 ms",
    ]


@given(rates, rates, st.fractions(0, 500), st.fractions(0, 500))
def test_nothing_is_earlier_than_it_arrives_nor_later_than_promised(
    hr_hz: Fraction, measurement_hz: Fraction, delay_ms: Fraction, more_ms: Fraction
) -> None:
    hr_hz = max(hr_hz, measurement_hz)
    times = Times.of(measurement_hz, delay_ms, delay_ms + more_ms)
    N, M, L = times.steps(hr_hz)
    assert N is not None
    assert M is not None
    assert L is not None
    assert N / hr_hz <= 1 / measurement_hz < (N + 1) / hr_hz
    assert (M - 1) / hr_hz < delay_ms / 1000 <= M / hr_hz
    assert times.landing_ms(L, hr_hz) <= delay_ms + more_ms < times.landing_ms(L + 1, hr_hz)
    assert times.wait(hr_hz) == roundings(hr_hz / measurement_hz, 0)[1]


@pytest.mark.parametrize(
    ("times", "said"),
    [
        ((0, 1, None), "measurement_hz is 0: it must be greater than 0"),
        ((5, -1, None), "delay_ms is -1: it must be 0 or more"),
        ((5, 20, 10), "land_within_ms is 10: it must not be less than the delay, 20 ms"),
        ((500, 0, None), "measurement_hz 500 is above hr_hz 400: a step takes one measurement at the most"),
        ((30, 20, 21), "land_within_ms 21 is before .* 21.667 ms after the measurement is taken; give 21.667 or more"),
        ((5, "soon", None), "delay_ms is 'soon': give a finite number"),
    ],
)
def test_times_that_cannot_be(times: tuple[object, ...], said: str) -> None:
    with pytest.raises(InputError, match=said):
        Timing.at(400, *times)  # type: ignore[arg-type]


def test_the_highest_rate_of_recalculate_holds_the_delay_in_seconds() -> None:
    """100 ms late at 2 Hz: at 40 Hz it replays 4 steps, at 270 Hz 27, and at 271 Hz 28, which is too much."""
    costs = on_cortex_m4f("recalculate")
    found = fit(costs, Timing(20, 4, 20), 40)
    assert found.highest_hz == 270
    assert fit(costs, Timing.at(270, 2, 100), 270).fits
    assert not fit(costs, Timing.at(271, 2, 100), 271).fits


@settings(max_examples=20)
@given(
    method=st.sampled_from(["standard", "recalculate", "larsen", "dual-rate"]),
    measurement_hz=st.sampled_from([1, 2, 5, 7]),
    delay=st.fractions(0, 1, max_denominator=20),
    period_ms=st.none() | st.sampled_from([3, 4, 10]),
)
def test_at_the_highest_rate_all_holds_and_a_little_above_it_does_not(
    method: str, measurement_hz: int, delay: Fraction, period_ms: int | None
) -> None:
    """But for what rounding to steps lets by: of three rates above, one at least is too fast."""
    costs, start = on_cortex_m4f(method), Fraction(100)
    times = Times(Fraction(measurement_hz), delay * 900 / measurement_hz)
    tasks = [] if period_ms is None else [Task("control", start * period_ms / 1000, Fraction(1, 5000), 5)]
    highest = highest_rate(costs, times, start, Options(), tasks)
    assert highest is not None

    def lands(rate: Fraction) -> int | None:
        N, M, _ = times.steps(rate)
        assert N is not None
        timing = Timing(N, M or 0, METHODS[method].law("next-step").latest(N, M or 0))
        at = [replace(task, period=task.period * rate / start, deadline=None) for task in tasks]
        return landing(costs, timing, 1 / rate, Options(), at)

    assert lands(highest) is not None
    assert any(lands(highest * more) is None for more in (Fraction(101, 100), Fraction(103, 100), Fraction(11, 10)))


def test_a_task_that_takes_longer_than_its_period_is_refused() -> None:
    task = Task("control", Fraction(8, 5), Fraction(4, 100), priority=5)
    said = "task 'control' alone needs 1000 % of the processor: its cost is 40 ms and its period 4 ms; mend them"
    with pytest.raises(InputError, match=said):
        fit(on_cortex_m4f("larsen"), Timing(80, 44, 80), 400, tasks=[task])


@pytest.mark.parametrize("hr_hz", ["400", "892.9", "871/2"])
def test_a_rate_that_fits_is_no_higher_than_the_highest(hr_hz: str) -> None:
    costs = on_cortex_m4f("larsen")
    found = fit(costs, Timing.at(hr_hz, 5, 100), hr_hz)
    assert found.fits
    assert found.highest_hz is not None
    assert found.highest_hz >= Fraction(hr_hz)
