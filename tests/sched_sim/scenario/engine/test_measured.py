"""The measurements of compiled code are those of the sensors."""

from __future__ import annotations

from fractions import Fraction
from itertools import chain

from hypothesis import given
from hypothesis import strategies as st

from sched_sim.scenario.engine.measured import measured
from sched_sim.scenario.engine.memory import NEVER
from sched_sim.scenario.instants import spread
from tests.scenarios import BY_HAND, scenario, sensor

times = st.one_of(st.integers(0, 9), st.fractions(0, 9, max_denominator=12), st.just(Fraction(3**37, 2**58)))
delays = st.one_of(st.lists(times, min_size=1, max_size=5), st.builds(lambda one, more: spread(one, one + more),
                   st.fractions(0, 9, max_denominator=9), st.fractions(0, 9, max_denominator=9)))  # fmt: skip


@given(
    st.lists(st.tuples(st.fractions(1, 20, max_denominator=12), times, delays), min_size=1, max_size=3),
    st.integers(1, 60),
)
def test_they_are_taken_and_arrive_as_the_sensors_have_them(several, steps):
    sensors = [
        sensor(name, every, late, offset=offset, dropout=0.3, land_by=99)
        for name, (every, offset, late) in zip("abc", several, strict=False)
    ]
    of = scenario(10, BY_HAND | {f"correct.{each.name}": 1 for each in sensors}, *sensors, steps=steps)
    expected = sorted(
        chain.from_iterable(
            ((step, number, NEVER if late is None else step + late) for step, late in each.measurements(steps, of.seed))
            for number, each in enumerate(sensors)
        )
    )
    assert [*zip(*(column.tolist() for column in measured(of, of.seed)), strict=True)] == expected
