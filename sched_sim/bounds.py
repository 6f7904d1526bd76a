"""The one place where what the user gives is bounded.

Every bound lies far beyond any design; what is above is a slip of the keyboard, or would run or fill the memory without
end. Messages name the option or the key, the value and the bound.
"""

from __future__ import annotations

from collections.abc import Sized
from decimal import Decimal
from fractions import Fraction
from operator import index

from sched_sim.errors import InputError

MOST_DIGITS = 50
"""Digits of a number: exact arithmetic takes them all."""
LARGEST_EXPONENT = 18
"""Costs and speeds of any unit lie between 1e-18 and 1e18."""
MOST_STEPS = 10_000_000
"""HR steps of a design, a delay and a simulation: more than a day at 100 Hz."""
MOST_JOBS = 20_000_000
"""Released in one simulation."""
MOST_JOBS_TO_REPEAT = 1_000_000
"""Released until all has begun and been seen once: a search for the least speed simulates that some thirty times."""
MOST_STATES = 200
"""States of a measured system; inputs and measurements too. Its operations grow with the third power."""
MOST_IN_FLIGHT = 1_000
"""Measurements on their way at once, where a least speed is searched by simulation."""
MOST_TASKS = 1_000
"""The user's, beside the filter."""
MOST_SENSORS = 100
"""A scenario's: each is drawn, and compared with every other."""
MOST_BYTES = 64_000_000
"""The size of an input file."""
MOST_SHOWN = 60
"""Characters of a value in a message."""


def short(value: object) -> str:
    """A value for a message, its middle left out where it is long."""
    if isinstance(value, int) and abs(value) >= 10**MOST_SHOWN:
        return f"about {'-' if value < 0 else ''}1e{int(abs(value).bit_length() * 0.30103)}"
    text = str(value)
    return text if len(text) <= MOST_SHOWN else f"{text[: MOST_SHOWN // 2]} ... {text[-MOST_SHOWN // 4 :]}"


def check_digits(value: int | Decimal | str, what: str) -> None:
    """Raises InputError for a number of more than MOST_DIGITS digits, in its exponent or before it, before anything
    computes with it."""
    if isinstance(value, int):
        long = abs(value) >= 10**MOST_DIGITS
    elif isinstance(value, str):
        long = len(value) > MOST_DIGITS and sum(map(str.isdigit, value)) > MOST_DIGITS
    else:
        long = value.is_finite() and max(len(value.as_tuple().digits), abs(value.adjusted())) > MOST_DIGITS
        if long and len(value.as_tuple().digits) <= MOST_DIGITS:
            check_size(value, what, value)
    if long:
        raise InputError(f"{what} is {short(value)}: give a number of at most {MOST_DIGITS} digits")


def check_size(number: Decimal | Fraction, what: str, entry: object) -> None:
    """Raises InputError for a number far from 1, as no unit of cost, speed or time makes it. entry: how it was
    written. A Decimal is not computed with: 1e999999999 fills the memory."""
    if isinstance(number, Decimal):
        far = number.is_finite() and bool(number) and abs(number.adjusted()) > LARGEST_EXPONENT
    else:
        far = bool(number) and not Fraction(1, 10**LARGEST_EXPONENT) <= abs(number) < 10 ** (LARGEST_EXPONENT + 1)
    if far:
        raise InputError(
            f"{what} is {short(entry)}: give a number between 1e-{LARGEST_EXPONENT} and 1e{LARGEST_EXPONENT}"
        )


def whole(value: int, what: str, most: int = MOST_STEPS) -> int:
    """A whole number, also one of NumPy's. Raises InputError for anything else, and for one above `most`, by default of
    HR steps."""
    try:
        number = index(value)
    except TypeError:
        raise InputError(f"{what} is {short(repr(value))}: give a whole number") from None
    if number > most:
        raise InputError(f"{what} is {short(number)}: give at most {most:,}")
    return number


def at_least_one(value: int, what: str) -> int:
    """`whole`, and at least 1."""
    number = whole(value, what)
    if number < 1:
        raise InputError(f"{what} is {short(number)}: give at least 1")
    return number


def check_sensors(sensors: Sized) -> None:
    """Raises InputError for more than MOST_SENSORS."""
    if len(sensors) > MOST_SENSORS:
        raise InputError(f"there are {len(sensors):,} sensors: give at most {MOST_SENSORS}")


def check_kind(value: object, kind: type | tuple[type, ...], what: str, needed: str) -> None:
    """Raises InputError for a value of another kind. needed: what to give."""
    if not isinstance(value, kind):
        raise InputError(f"{what} is {short(repr(value))}: give {needed}")
