"""The random words of compiled code are NumPy's."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from sched_sim.scenario.draws import stream
from sched_sim.scenario.engine.words import STREAM_SIZE, stream_of, total
from tests.sched_sim.scenario.test_draws import draws


class Times(dict[int, int]):
    """A memory with a stream, and the part that takes 0, 1, 2, ... at address 0."""

    def __missing__(self, address: int) -> int:
        return address - 1


@given(st.integers(0, 2**64), st.text(), st.lists(draws, max_size=30))
def test_a_total_is_that_of_numpys_draws(seed, purpose, several):
    generator = stream(seed, purpose)
    address = -STREAM_SIZE
    memory = Times(enumerate(stream_of(generator.bit_generator.state), start=address))
    for count, executions in several:
        memory[0] = count
        expected = sum(generator.integers(count, size=executions).tolist())
        assert total(memory, 0, address, executions) == expected
