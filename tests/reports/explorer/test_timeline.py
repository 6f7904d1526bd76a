"""A schedule made ready for drawing, beside what the printed chart draws."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from fractions import Fraction
from typing import Any

import pytest
from playwright.sync_api import Browser

from sched_sim.costs.table_file import load_costs
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.schedule import intervals
from sched_sim.schedule.outcome import Schedule
from studies.explorer.schedule import shown
from tests.reports.explorer.scripts import Ask, asking

CASES = {
    "it fits": (Timing(10, 4, 8), "0.77", Options()),
    "it misses": (Timing(10, 4, 8), "0.6", Options()),
    "with switches": (Timing(20, 8, 16), "0.9", Options(context_switch=Fraction(1, 50))),
    "two processors": (Timing(20, 8, 16), "0.8", Options(cpus=2)),
}


def simulated(timing: Timing, speed: str, options: Options) -> Schedule:
    costs = select(load_costs("steffes2014"), "dual-rate", options, "minimum")
    return simulate(costs, timing, Fraction(speed), 2, options, keep_slices=True)


@pytest.fixture(scope="module")
def ask(browser: Browser) -> Iterator[Ask]:
    with asking(browser, "timeline") as ask:
        yield ask


@pytest.mark.parametrize("case", CASES)
def test_jobs_wait_and_work_late_where_the_printed_chart_says(case: str, ask: Ask) -> None:
    schedule = simulated(*CASES[case])
    steps = schedule.horizon // schedule.period
    document = asdict(shown(schedule, steps, [], "", None))
    line = ask(
        """const { rows } = of.timeline(a);
        return rows.map(({ waits, start, end, late, arrows }) => ({
          waits: waits.start.map((from, at) => [from, waits.end[at]]),
          late: [...late].flatMap((from, at) => (from < Infinity ? [[from, end[at]]] : [])),
          bars: [...start].map((from, at) => [from, end[at]]),
          release: [...arrows.release.at], deadline: [...arrows.deadline.at], missed: [...arrows.missed],
        }));""",
        document,
    )
    assert line == [printed(schedule, row) for row in intervals.rows(schedule)]


def printed(schedule: Schedule, row: intervals.Row) -> dict[str, Any]:
    def in_steps(spans: Any) -> list[list[float]]:
        return [[start / schedule.period, end / schedule.period] for start, end in sorted(spans)]

    jobs = [job for job in intervals.jobs(schedule) if job.row == row]
    bars = [bar for bar in intervals.bars(schedule) if bar.row == row]
    waits = [span for job in jobs for span in intervals.waits(job, schedule.horizon)]
    late = intervals.overdue_work(bars)
    return {
        "waits": in_steps(united(waits)),
        "late": in_steps((start, end) for _, start, end in late),
        "bars": in_steps((bar.start, bar.end) for bar in bars),
        "release": sorted({job.release / schedule.period for job in jobs}),
        "deadline": sorted({job.deadline / schedule.period for job in jobs if not job.missed}),
        "missed": sorted({job.deadline / schedule.period for job in jobs if job.missed}),
    }


def united(spans: list[tuple[int, int]]) -> list[tuple[int, int]]:
    whole: list[tuple[int, int]] = []
    for start, end in sorted(spans):
        if whole and start <= whole[-1][1]:
            whole[-1] = whole[-1][0], max(end, whole[-1][1])
        else:
            whole.append((start, end))
    return whole
