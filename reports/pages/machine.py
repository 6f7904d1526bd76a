"""What differs from machine to machine, and how every report marks it: one sign, explained in the same words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

MARK = "†"


def marked(text: str) -> str:
    """A heading of which all below differs from machine to machine."""
    return f"{text} {MARK}"


def unmarked(heading: str) -> str:
    """The text that was `marked`."""
    return heading.removesuffix(f" {MARK}")


def timed_on(about: Mapping[str, Any]) -> str:
    """Where, when and how something was timed, and that the machine was busy if it was.

    about: the provenance of a measured cost table.
    """
    versions = ", ".join(f"{name} {number}" for name, number in about["versions"].items())
    protocol = about["protocol"]
    times = protocol["repetitions"]
    rounds = f"{protocol['rounds']} rounds of {times} repetition{'s' * (times != 1)}"
    busy = f", **which was busy** ({about['busy']}): times may be too long" if "busy" in about else ""
    return f"{about['machine']}, {about['date']} ({versions}; {rounds}){busy}"


def legend(timed: str, *, residues: bool = False) -> str:
    """What the mark means. timed: from `timed_on`. residues: whether some of what is marked is nothing but rounding."""
    rounding = (
        f" What is nothing but rounding, the difference of two ways to compute one thing, is marked {MARK} too and has "
        f"one digit."
        if residues
        else ""
    )
    return (
        f"**{MARK} differs from machine to machine**: timed, or following from times, on {timed}.{rounding} All else "
        f"is the same on every machine, to the digits that are shown."
    )


def residue(value: float) -> str:
    """A rounding residue: its power of ten, and one digit."""
    return f"{value:.0e}"
