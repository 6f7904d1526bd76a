"""Figs 1 and 2 of Steffes (2014): drawn from a schedule, with the paper's annotations."""

from __future__ import annotations

from fractions import Fraction

import pytest
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgba

from reports.drawing.style import FILLS
from reports.steffes.timelines import dual_rate_timeline, serial_timeline, unused
from sched_sim.costs.table_file import load_costs
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule.intervals import jobs
from tests.reports.layout import flaws, texts

PAPER = load_costs("steffes2014")
LARSEN, SERIAL, DUAL_RATE = Fraction("1.47"), Fraction("1.26"), Fraction("0.77")
"""Least speeds; SERIAL: of steps that all propagate in 0.45, and update in 0.81."""


def test_figure_1_can_be_read_and_shows_the_unused_time() -> None:
    figure = serial_timeline(PAPER, Timing(10, 4, 8), SERIAL)
    assert flaws(figure) == []
    said = [text.get_text() for text, _ in texts(figure)]
    assert said.count("unused") == 7  # k-1 .. k+6, but for m
    assert {"$k$", "$m = l$", "measurement taken", "delayed measurement available"} <= set(said)


def test_figure_1_has_blocks_of_one_length_for_propagation() -> None:
    """The paper: "Assuming the propagation computations take the same amount of time regardless of the time step"."""
    figure = serial_timeline(PAPER, Timing(10, 4, 8), SERIAL)
    (axes,) = [axes for axes in figure.axes if axes.axison]
    colour = to_rgba(FILLS["P"].colour)
    boxes = [
        path.get_extents().width
        for drawn in axes.collections
        if isinstance(drawn, PolyCollection) and tuple(drawn.get_facecolor()[0]) == colour
        for path in drawn.get_paths()
    ]
    assert boxes == pytest.approx([0.45 / 1.26] * 30)  # of three cycles


def test_unused_time_is_what_the_jobs_leave() -> None:
    schedule = simulate(select(PAPER, "larsen", Options()), Timing(10, 4, 8), LARSEN, 2, keep_slices=True)
    free = unused(jobs(schedule), 0, schedule.horizon)
    assert sum(end - start for start, end in free) == schedule.horizon - schedule.busy
    assert not [step for step in (4, 14) for start, _ in free if start // schedule.period == step]


@pytest.mark.parametrize("speed", [DUAL_RATE, Fraction("0.78")])
def test_figure_2_can_be_read_and_has_the_six_steps(speed: Fraction) -> None:
    figure = dual_rate_timeline(PAPER, Timing(10, 4, 8), speed)
    assert flaws(figure) == []
    said = [text.get_text() for text, _ in texts(figure)]
    assert said.count("1") == 12  # above the HR job of each step k-1 .. k+9, and in the key
    assert [said.count(number) for number in "23456"] == [2] * 5
    assert {"$k$", "$m$", "$l$", "LRP", "LRU", "delayed measurement"} <= set(said)


@pytest.mark.parametrize("timing", [Timing(10, 4, 10), Timing(5, 0, 2), Timing(20, 10, 11)])
def test_figure_2_for_other_designs(timing: Timing) -> None:
    assert flaws(dual_rate_timeline(PAPER, timing, Fraction("1.2"))) == []


def test_a_speed_that_misses_deadlines_is_refused() -> None:
    with pytest.raises(InputError, match=r"dual-rate: .* at speed 0\.7: give"):
        dual_rate_timeline(PAPER, Timing(10, 4, 8), Fraction("0.7"))
    with pytest.raises(InputError, match=r"larsen: .* at speed 1: give"):
        serial_timeline(PAPER, Timing(10, 4, 8), Fraction(1))
