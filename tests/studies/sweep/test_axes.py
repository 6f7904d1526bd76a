"""The values of an axis, from what the user typed."""

from decimal import Decimal
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.errors import InputError
from studies.sweep.axes import numbers, whole_numbers, words


def test_a_range_of_decimals_is_exact_and_holds_its_end():
    found = numbers("0.6:1.6:0.05", "--speed")
    assert len(found) == 21
    assert found[0] == Fraction(3, 5)
    assert found[1] == Fraction(13, 20)
    assert found[-1] == Fraction(8, 5)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("5", (5,)),
        ("1:4", (1, 2, 3, 4)),
        ("10:100:30", (10, 40, 70, 100)),
        ("1:10:4", (1, 5, 9)),
        ("5,1,2,2", (1, 2, 5)),
        (["7", "1:3"], (1, 2, 3, 7)),
        ([4, "1:2"], (1, 2, 4)),
        (3, (3,)),
        ("1e2", (100,)),
    ],
)
def test_whole_numbers(text, expected):
    assert whole_numbers(text, "-N", at_least=1) == expected


def test_numbers_of_a_file_are_the_decimals_that_were_written():
    assert numbers([Decimal("0.1"), "1/3"], "speed") == (Fraction(1, 10), Fraction(1, 3))
    assert numbers("0", "context_switch", zero=True) == (0,)


@pytest.mark.parametrize(
    "text", ["", "x", "0", "-1", "1.5", "1,", "4:1", "1:2:3:4", "1:5:0", "1:5:-1", ":", "nan", "inf", True, []]
)
def test_what_is_no_whole_number_is_an_error_that_names_the_option(text):
    with pytest.raises(InputError, match="-N"):
        whole_numbers(text, "-N", at_least=1)


@pytest.mark.parametrize("text", ["0", "0:1", "-0.5", "NaN", "0.6:1.6:0", "1:2:1e-9", "1/0"])
def test_what_is_no_speed_is_an_error_that_names_the_option(text):
    with pytest.raises(InputError, match="--speed"):
        numbers(text, "--speed")


def test_words_come_in_the_known_order():
    assert words(["b,a", "b"], "--method", ["a", "b", "c"]) == ("a", "b")
    with pytest.raises(InputError, match=r"--method 'd' is unknown: choose from a, b, c"):
        words("a,d", "--method", ["a", "b", "c"])


@given(
    first=st.decimals("0.001", "10", places=3),
    step=st.decimals("0.001", "1", places=3),
    count=st.integers(1, 50),
)
def test_ranges_do_not_drift(first, step, count):
    last = first + (count - 1) * step
    assert numbers(f"{first}:{last}:{step}", "--speed") == tuple(
        Fraction(first) + i * Fraction(step) for i in range(count)
    )
