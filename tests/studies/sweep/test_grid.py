"""Design indexes against the product of the axes, filtered point by point."""

from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.costs.methods import DELAYED_METHODS, PAPER_METHODS, TWO_RATE_METHODS
from sched_sim.costs.table_file import load_costs
from sched_sim.design.methods import METHODS
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from studies.sweep.grid import Grid
from studies.sweep.legal import Legal

STEFFES, COUNTED = load_costs("steffes2014"), load_costs("counted-9-3-3")

METHOD = st.sampled_from([*METHODS])
FEEDBACK = st.sampled_from(["next-step", "same-step"])


def axis(least: int) -> st.SearchStrategy[tuple[int, ...]]:
    return st.lists(st.integers(least, 12), min_size=1, max_size=5, unique=True).map(sorted).map(tuple)


def is_legal(method, feedback, N, M, L):
    try:
        timing = Timing(N, M, L)
        METHODS[method].check(timing, feedback)
    except InputError:
        return False
    if max(M, L) > N and not METHODS[method].law(feedback).several:
        return False
    return M == 0 or method not in TWO_RATE_METHODS


def legal_designs(method, feedback, Ns, Ms, Ls):
    """One by one, by the rules of `sched_sim.design.timing`."""
    only_m = method in DELAYED_METHODS and method not in ("dual-rate", "delayed-horizon")
    for N in Ns:
        for M in Ms or range(N + only_m):
            latest = (M // N + 1) * N if method == "dual-rate" else N
            latest -= method == "dual-rate" and feedback == "same-step"
            every_L = [M] if only_m else range(latest + 1)
            for L in Ls or every_L:
                if is_legal(method, feedback, N, M, L):
                    yield N, M, L


def combinations_without_a_design(designs, Ns, Ms, Ls):
    """Of the given values; None is a value not given."""
    found = {(N, M if Ms else None, L if Ls else None) for N, M, L in designs}
    return sum(combination not in found for combination in product(Ns, Ms or [None], Ls or [None]))


@given(METHOD, FEEDBACK, axis(1), st.none() | axis(0), st.none() | axis(0), st.data())
def test_legal_designs_are_those_of_the_filtered_product(method, feedback, Ns, Ms, Ls, data):
    legal = Legal(METHODS[method].law(feedback), Ns, Ms, Ls)
    expected = list(legal_designs(method, feedback, Ns, Ms, Ls))
    assert legal.size == len(expected)
    assert legal.left_out == combinations_without_a_design(expected, Ns, Ms, Ls)
    if expected:
        start = data.draw(st.integers(0, len(expected) - 1))
        stop = data.draw(st.integers(start + 1, len(expected)))
        found = legal.designs(start, stop)
        assert list(zip(*(values.tolist() for values in found), strict=True)) == expected[start:stop]


def points(grid, start, stop):
    """(table, method, options, N, M, L, speed) of each point, read from the chunks."""
    for span in grid.spans(range(start, stop), lambda _: 7):
        chunk = grid.chunk(span.start, span.stop)
        assert chunk.points == span
        for position in chunk.positions:
            design, at = divmod(position, max(len(grid.speeds), 1))
            N, M, L = (int(values[design]) for values in chunk.designs)
            speed = grid.speeds[at] if grid.speeds else None
            yield chunk.block.table, chunk.block.method, chunk.block.options, N, M, L, speed


@given(
    Ns=axis(1),
    Ms=st.none() | axis(0),
    Ls=st.none() | axis(0),
    speeds=st.integers(0, 3),
    methods=st.lists(st.sampled_from(PAPER_METHODS), min_size=1, unique=True),
    feedbacks=st.lists(FEEDBACK, min_size=1, unique=True),
    data=st.data(),
)
def test_the_index_counts_the_legal_points(Ns, Ms, Ls, speeds, methods, feedbacks, data):
    paces = tuple(Fraction(number, 10) for number in range(1, speeds + 1))
    options = tuple(Options(feedback=feedback) for feedback in feedbacks)
    expected = [
        ("counted-9-3-3", method, option, N, M, L, speed)
        for method, option in product(methods, options)
        for N, M, L in legal_designs(method, option.feedback, Ns, Ms, Ls)
        for speed in paces or [None]
    ]
    if not expected:
        with pytest.raises(InputError, match="the grid is empty"):
            Grid(Ns, Ms, Ls, paces, tuple(methods), (COUNTED,), options)
        return
    grid = Grid(Ns, Ms, Ls, paces, tuple(methods), (COUNTED,), options)
    assert grid.size == len(expected)
    assert list(points(grid, 0, grid.size)) == expected
    start = data.draw(st.integers(0, grid.size - 1))
    stop = data.draw(st.integers(start + 1, grid.size))
    assert list(points(grid, start, stop)) == expected[start:stop]


def test_a_grid_far_larger_than_memory_is_only_counted():
    N = 2000
    grid = Grid(tuple(range(1, N + 1)), None, None, (), ("dual-rate",), (STEFFES,), (Options(),))
    assert grid.size == N * (N + 1) * (N + 2) // 6  # all 0 <= M < L <= N
    last = grid.chunk(grid.size - 1, grid.size).designs
    assert [values.tolist() for values in last] == [[N], [N - 1], [N]]


def test_an_empty_grid_says_what_was_given():
    said = r"none of the 1 combinations of N=5, M=6, L=3 is legal: .*M <= L for standard"
    with pytest.raises(InputError, match=said):
        Grid((5,), (6,), (3,), (), ("recalculate",), (STEFFES,), (Options(),))


def test_what_a_table_cannot_tell_the_cost_of_is_left_out():
    grid = Grid((5,), (6,), None, (), PAPER_METHODS, (STEFFES,), (Options(),))
    assert [block.method for block in grid.blocks] == list(PAPER_METHODS)
    assert {found[1] for found in points(grid, 0, grid.size)} == {"standard", "recalculate", "dual-rate"}
    assert (grid.size, grid.left_out) == (1 + 1 + 4, 1)
    with pytest.raises(InputError, match=r"is legal: .*no \[costs.larsen\] gain, correct, compensate"):
        Grid((5,), (6,), None, (), ("larsen",), (STEFFES,), (Options(),))


def test_tables_of_one_name_are_refused():
    with pytest.raises(InputError, match="two cost tables are named 'steffes2014'"):
        Grid((5,), None, None, (), PAPER_METHODS, (STEFFES, STEFFES), (Options(),))


def test_a_missing_entry_of_a_table_is_an_error():
    with pytest.raises(InputError, match=r"no entry \[costs.dual-rate\] lr_gain"):
        Grid((5,), None, None, (), PAPER_METHODS, (STEFFES,), (Options(gain="precomputed"),))
