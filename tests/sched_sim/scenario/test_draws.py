"""Draws in blocks are those that NumPy makes one by one."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from sched_sim.scenario.draws import BLOCK, stream, total, words

COUNTS = (1, 2, 3, 7, 1000, 3 << 30, (1 << 32) - 1)
"""Of 3 x 2^30 numbers every fourth word comes too often."""
draws = st.tuples(st.sampled_from(COUNTS), st.integers(0, 40))


@given(st.integers(0, 2**64), st.text(), st.lists(draws, max_size=30))
def test_a_total_is_that_of_numpys_draws(seed, purpose, several):
    one_by_one, in_blocks = stream(seed, purpose), words(seed, purpose)
    for count, executions in several:
        expected = sum(one_by_one.integers(count, size=executions).tolist())
        assert total(range(count), in_blocks, executions) == expected


def test_a_block_ends_unseen():
    one_by_one, in_blocks = stream(1, "gps cost"), words(1, "gps cost")
    for executions in (BLOCK - 1, 3, BLOCK, 2 * BLOCK):
        expected = sum(one_by_one.integers(10, size=executions).tolist())
        assert total(range(10), in_blocks, executions) == expected
