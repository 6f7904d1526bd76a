"""Between which bounds a whole number lies that is computed from others."""

from __future__ import annotations

from filters.translation.kinds import LARGEST, Int


def total(a: Int, b: Int) -> Int:
    """a + b."""
    return Int(
        None if a.low is None or b.low is None else a.low + b.low,
        None if a.high is None or b.high is None else a.high + b.high,
    )


def negative(a: Int) -> Int:
    """-a."""
    return Int(None if a.high is None else -a.high, None if a.low is None else -a.low)


def difference(a: Int, b: Int) -> Int:
    """a - b."""
    return total(a, negative(b))


def product(a: Int, b: Int) -> Int:
    """a b; without bounds unless both have all, or neither is negative."""
    if None not in (a.low, a.high, b.low, b.high):
        corners = [x * y for x in (a.low, a.high) for y in (b.low, b.high) if x is not None and y is not None]
        return Int(min(corners), max(corners))
    if a.low is not None and b.low is not None and a.counts and b.counts:
        return Int(a.low * b.low)
    return Int()


def steps_past_int(a: Int, b: Int, sign: str) -> bool:
    """Whether a number without bounds, as the step is, meets one that takes it past an int long before it is there
    itself: no length of an array, which indices are made of."""
    open_ended = [x for x in (a, b) if x.low is None or x.high is None]
    sizes = [abs(x.known) for x in (a, b) if x.known is not None]
    return len(open_ended) == 1 and len(sizes) == 1 and sizes[0] >= (LONGEST if sign == "*" else LARGEST // 2)


LONGEST = 2**15
"""Of rows that an index is multiplied by."""


def quotient(a: Int, b: Int) -> Int:
    """a // b."""
    if a.known is not None and b.known:
        return Int(a.known // b.known, a.known // b.known)
    return Int(0, a.high) if a.counts and b.counts else Int()


def remainder(a: Int, b: Int) -> Int:
    """a % b, whose sign is that of b."""
    if a.known is not None and b.known:
        return Int(a.known % b.known, a.known % b.known)
    if b.counts:
        if b.known is not None and a.counts and a.high is not None and a.high < b.known:
            return a
        return Int(0, None if b.high is None else b.high - 1)
    return Int()
