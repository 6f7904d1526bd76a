"""Figures of live runs: they can be read, and show what was predicted and measured."""

from __future__ import annotations

import pytest

from reports.charts.chart import gantt
from reports.live.beside import beside_panels, rate_of
from reports.live.histograms import histograms_figure
from reports.live.staircase import staircase_figure
from sched_sim.schedule.intervals import bars
from studies.live.jobs import Ran
from studies.live.measure import Measured, measured
from studies.live.stairs import through_two_steps
from tests.reports.layout import flaws, texts
from tests.studies.live.recorded import MS, design, judged, perfect


def perfect_run(speed: str, cycles: int = 8, N: int = 10, M: int = 4) -> Measured:
    of = design(speed, cycles, N=N, M=M)
    assert of.predicted is not None
    return measured(Ran(tuple(perfect(of)), 0), of, of.predicted)


@pytest.mark.parametrize("name", ["ordinary", "swapped"])
def test_what_ran_is_below_what_was_simulated(name: str) -> None:
    run = judged(name)
    simulated, ran = beside_panels(run, swapped=name == "swapped")
    assert (simulated.first, simulated.end) == (ran.first, ran.end) == (10, 30)
    assert flaws(gantt([simulated, ran], hr_hz=rate_of(run))) == []
    marks = {mark.text: mark.step for mark in ran.marks}
    assert marks["l"] == (17 if name == "ordinary" else 15)
    assert {mark.text: mark.step for mark in simulated.marks}["l"] == 17
    assert (ran.schedule.misses > 0) == (name == "swapped")


def test_of_a_perfect_kernel_both_panels_are_the_same() -> None:
    simulated, ran = beside_panels(perfect_run("0.85"))
    first = [(bar.style, bar.start / simulated.schedule.period) for bar in bars(simulated.schedule)]
    second = [(bar.style, bar.start / ran.schedule.period) for bar in bars(ran.schedule)]
    assert [style for style, _ in first] == [style for style, _ in second]
    assert [start for _, start in first] == pytest.approx([start for _, start in second])


def test_a_long_cycle_is_shown_alone() -> None:
    simulated, ran = beside_panels(perfect_run("0.85", 2, N=40, M=20))
    assert (simulated.first, simulated.end) == (ran.first, ran.end) == (40, 80)


def test_histograms_can_be_read() -> None:
    ordinary, swapped = judged("ordinary"), judged("swapped")
    wide = ordinary._replace(
        achieved=[7, 7, 7, 8, None, 24, 7, 7], taken=[100_000, 40 * MS] * 4, wake=[20_000] * 99 + [40 * MS]
    )
    for run in (ordinary, swapped, wide, ordinary._replace(achieved=[None] * 8)):
        assert flaws(histograms_figure(run)) == []


def test_what_landed_elsewhere_has_a_colour_of_its_own() -> None:
    moved = judged("ordinary")._replace(achieved=[7, 7, 7, 8, 7, 7, 7, 7])
    right, elsewhere = histograms_figure(moved).axes[0].patches
    assert right.get_facecolor() != elsewhere.get_facecolor()
    for run, there in ((moved, True), (judged("ordinary"), False)):
        assert ("landed elsewhere" in {text.get_text() for text, _ in texts(histograms_figure(run))}) == there


def test_logarithmic_axes_say_that_they_are() -> None:
    for axes in histograms_figure(judged("ordinary")).axes[:3]:
        assert (axes.get_xscale() == "log") == ("logarithmic" in axes.get_xlabel())


def test_shares_are_of_all_cycles_whatever_they_are() -> None:
    """The bars begin at 0 and the axis ends at 100 %; the legend is of what is there."""
    for run in (perfect_run("0.85"), judged("ordinary")._replace(achieved=[8] * 8)):
        figure = staircase_figure([run])
        assert figure.axes[1].get_ylim() == (0, 100)
        said = {text.get_text() for text, _ in texts(figure)}
        assert ("measured elsewhere" in said) == (run.agreement.share < 1)
        assert "later than shown" not in said


def test_the_staircase_can_be_read() -> None:
    runs = [measured(judged("ordinary").ran, of, of.predicted or 0) for of in through_two_steps(design())]
    figure = staircase_figure(runs)
    assert flaws(figure) == []
    (step,) = [patch for patch in figure.axes[0].patches if hasattr(patch, "get_data")]
    assert list(step.get_data().values) == [8, 7, 6]
    assert "measured elsewhere" in {text.get_text() for text, _ in texts(figure)}


def test_what_lands_very_late_does_not_hide_the_staircase() -> None:
    late = judged("ordinary")._replace(achieved=[7, 7, 7, 111, None, None, 7, 7])
    figure = staircase_figure([late])
    assert flaws(figure) == []
    assert figure.axes[0].get_ylim()[1] < 12
    assert "later than shown" in {text.get_text() for text, _ in texts(figure)}
    assert "achieved l (3 later or left out)" in {text.get_text() for text, _ in texts(histograms_figure(late))}


def test_a_staircase_without_undisturbed_cycles() -> None:
    run = judged("ordinary")
    run = run._replace(disturbed=[True] * 8, achieved=[None] * 8)
    assert flaws(staircase_figure([run])) == []
