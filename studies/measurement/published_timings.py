"""Timings that others published, beside what the counts of the same job predict on the same part at the same clock."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property
from importlib.resources import files
from typing import Any, Literal

from filters.backends.counted import Operations
from sched_sim.processors.part import Part, at_clock, seconds_for
from sched_sim.processors.part_file import load_part
from studies.measurement.methods import nonzero
from studies.measurement.published_jobs import JOBS, Call, Sizes, counted

Written = Literal["plain loops", "with more around it", "generic matrix class", "zeros left out", "left out of both"]


@dataclass(frozen=True)
class PublishedTiming:
    """A job's execution time on a part, as `source` at `url` has it.

    states, measurements, noises: sizes of the job; no measurements where it has none or they are not stated, the noises
    those of G in G Q G^T, 0 where Q is given as a matrix.
    job: one of `JOBS`. written: how: "plain loops" are dense and in C, as they are counted. code: what it is, in words.
    least_us, most_us: the time, microseconds.
    """

    source: str
    url: str
    part: str
    board: str
    clock_mhz: int
    states: int
    measurements: int
    noises: int
    job: str
    written: Written
    code: str
    least_us: Fraction
    most_us: Fraction

    @property
    def calls(self) -> Sequence[Call]:
        """The functions that are the job."""
        return JOBS[self.job](Sizes(self.states, self.measurements, self.noises))

    @cached_property
    def operations(self) -> Operations:
        """What is counted of the job."""
        return counted(self.calls)

    @property
    def on(self) -> Part:
        """The part at the clock of the board."""
        return at_clock(load_part(self.part), Fraction(self.clock_mhz * 10**6))

    @cached_property
    def predicted_us(self) -> Fraction:
        """What the part takes for the counted operations of the job, microseconds."""
        return 10**6 * seconds_for(nonzero(self.operations), self.on, f"{self.source}, {self.job}")

    @property
    def ratios(self) -> tuple[Fraction, Fraction]:
        """Measured over predicted, least and most."""
        return self.least_us / self.predicted_us, self.most_us / self.predicted_us


@cache
def published_timings() -> tuple[PublishedTiming, ...]:
    """All of them, in the order of the file."""
    text = files("studies").joinpath("data/published-timings.toml").read_text(encoding="utf-8")
    return tuple(_timing(entry) for entry in tomllib.loads(text)["timing"])


def calibration(part: str) -> tuple[Fraction, Fraction] | None:
    """The least and the most measured over predicted of plain loops on the part of this name, if there are any."""
    ratios = [
        timing.ratios for timing in published_timings() if timing.part == part and timing.written == "plain loops"
    ]
    return (min(least for least, _ in ratios), max(most for _, most in ratios)) if ratios else None


def _timing(entry: Mapping[str, Any]) -> PublishedTiming:
    time = entry["published_us"]
    least, most = map(Fraction, time if isinstance(time, list) else (time, time))
    others = {key: value for key, value in entry.items() if key != "published_us"}
    return PublishedTiming(**{"noises": 0} | others, least_us=least, most_us=most)


# ------------------------------------------------------------------------------------------ the table of the page


def markdown() -> Sequence[str]:
    """The lines of the table in docs/explanation/published.md."""
    heading = ["source", "part", "states, measurements", "job", "code", "published, µs", "predicted, µs", "ratio"]
    rows = [_row(timing) for timing in published_timings()]
    return [f"| {' | '.join(row)} |" for row in (heading, ["---"] * 5 + ["---:"] * 3, *rows)]


def _row(timing: PublishedTiming) -> list[str]:
    sizes = f"{timing.states}, {timing.measurements}" if timing.measurements else str(timing.states)
    return [
        f"[{timing.source}]({timing.url})",
        f"`{timing.part}` at {timing.clock_mhz} MHz ({timing.board})",
        sizes,
        timing.job,
        timing.code,
        _range([_three_digits(us) for us in (timing.least_us, timing.most_us)]),
        _three_digits(timing.predicted_us),
        _range([f"{float(ratio):.2f}" for ratio in timing.ratios]),
    ]


def _three_digits(us: Fraction) -> str:
    return f"{float(us):.3g}" if us < 1000 else f"{round(us)}"


def _range(ends: Sequence[str]) -> str:
    return " to ".join(dict.fromkeys(ends))
