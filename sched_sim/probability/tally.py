"""What is counted of the jobs and the correction of each cycle: masses that are added."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import numpy as np

from sched_sim.probability.law import add, exceedance
from sched_sim.probability.outcome import Floats


class Tally:
    """Of one cycle, or of many together.

    jobs, missed: by kind; landing: mass by L; due, late: corrections whose time had come, and those that had not
    landed; behind: see `CycleProbabilities`; unknown: the same, for each cycle whose correction had not landed then;
    crowded: more HR updates in a step than so many.
    """

    def __init__(self) -> None:
        self.jobs: defaultdict[str, float] = defaultdict(float)
        self.missed: defaultdict[str, float] = defaultdict(float)
        self.responses: dict[str, Floats] = {}
        self.landing: defaultdict[int, float] = defaultdict(float)
        self.due = self.late = self.behind = self.unknown = 0.0
        self.crowded: defaultdict[int, float] = defaultdict(float)

    def job(self, kind: str, weight: float, missed: float) -> None:
        self.jobs[kind] += weight
        self.missed[kind] += missed

    def responded(self, kind: str, mass: Floats) -> None:
        add(self.responses, [(kind, mass)])

    def add(self, other: Tally, scale: float = 1.0) -> None:
        for kind, jobs in other.jobs.items():
            self.job(kind, scale * jobs, scale * other.missed[kind])
        for kind, mass in other.responses.items():
            self.responded(kind, scale * mass)
        for landed, share in other.landing.items():
            self.landing[landed] += scale * share
        self.due += scale * other.due
        self.late += scale * other.late
        self.behind += scale * other.behind
        self.unknown += scale * other.unknown
        for charged, share in other.crowded.items():
            self.crowded[charged] += scale * share

    def scaled(self, scale: float) -> Tally:
        tally = Tally()
        tally.add(self, scale)
        return tally

    def with_probability(self, share: float) -> Tally:
        """Of as many jobs and corrections, but seen only with this probability."""
        tally = self.scaled(share)
        tally.jobs, tally.due = self.jobs.copy(), self.due
        return tally

    def figures(self) -> Iterator[tuple[object, Floats]]:
        """All that is counted, by name."""
        for kind, missed in self.missed.items():
            yield ("missed", kind), np.array([missed])
        for kind, mass in self.responses.items():
            yield ("response", kind), exceedance(mass)
        for landed, share in self.landing.items():
            yield ("landing", landed), np.array([share])
        yield "late", np.array([self.late])
        yield "behind", np.array([self.behind])


class Tallies(defaultdict[int, Tally]):
    """By the number of the cycle."""

    def __init__(self) -> None:
        super().__init__(Tally)

    def together(self) -> Tally:
        """Of all of them."""
        sum_of_all = Tally()
        for tally in self.values():
            sum_of_all.add(tally)
        return sum_of_all
