"""Exact quotients of whole numbers, one or a whole array of them, and which is the larger."""

from __future__ import annotations

from typing import Generic, NamedTuple

from sched_sim.design.whole import Flags, Whole, filled, where


class Quotient(NamedTuple, Generic[Whole]):
    """Elementwise numerator / denominator (denominators positive), with a code that says where it comes from."""

    numerator: Whole
    denominator: Whole
    code: Whole


def quotient(numerator: Whole, denominator: Whole | int, code: int) -> Quotient[Whole]:
    """A number over a number, or an array over either."""
    return Quotient(numerator, 0 * numerator + denominator, filled(numerator, code))


def choose(condition: bool | Flags, yes: Quotient[Whole], no: Quotient[Whole]) -> Quotient[Whole]:
    """`yes` where the condition holds, else `no`."""
    return Quotient(*(where(condition, a, b) for a, b in zip(yes, no, strict=True)))


def exceeds(first: Quotient[Whole], second: Quotient[Whole]) -> bool | Flags:
    return first.numerator * second.denominator > second.numerator * first.denominator


def largest(*quotients: Quotient[Whole]) -> Quotient[Whole]:
    """The elementwise maximum; the first of equals."""
    result = quotients[0]
    for quotient in quotients[1:]:
        result = choose(exceeds(quotient, result), quotient, result)
    return result


def smaller(first: Quotient[Whole], second: Quotient[Whole]) -> Quotient[Whole]:
    return choose(exceeds(first, second), second, first)
