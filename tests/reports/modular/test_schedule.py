"""Figures and tables on the rocket's filter on slow processors: their numbers are those they were given, and they can
be read."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from filters.arrays import FloatArray
from filters.systems.rocket_filter import SENSORS, PredictorName
from reports.charts.chart import gantt
from reports.modular.schedule import (
    LEVELS,
    landing_figure,
    landings,
    miss_figure,
    miss_rows_of,
    miss_table,
    response_figure,
    responses,
    share_rows,
    verdict_rows,
)
from reports.modular.schedule_gantt import DELAY, fix_frames, fix_panels, fix_rows
from reports.modular.styles import WAY_NAMES
from reports.pages.stored import Rows, records
from sched_sim.costs.sample_file import SampledCosts
from sched_sim.schedule.intervals import bars as bars_of
from sched_sim.schedule.intervals import never_ran
from studies.modular.rocket_schedule import JOBS, URGENCIES, WAYS, MissRow, Run, chosen
from tests.reports.layout import flaws, texts

GRID = (1000, 200, 40, 10)
PARTS = {"predict": 4, "predict_accumulate": 5} | {
    f"{kind}.{name}": 1 for kind in ("correct", "correct_accumulate", "correct_late") for name in SENSORS
}
COSTS: dict[PredictorName, SampledCosts] = {
    name: SampledCosts(name, "cycle", {part: (Fraction(time * 1000),) for part, time in PARTS.items()})
    for name in ("unscented", "extended")
}


def rows() -> list[MissRow]:
    """The slower, the more misses; the urgent ones twice as many, the later ways of `WAYS` fewer."""
    found = []
    for (number, way), (doubled, urgency), (at, clock_mhz), job in product(
        enumerate(WAYS), enumerate(URGENCIES), enumerate(GRID), JOBS
    ):
        misses = (doubled + 1) * at * 100 // (number + 1)
        found.append(MissRow(way.name, urgency, clock_mhz, job, misses, 600, 500, misses / 7, 0.1 * at))
    return found


@pytest.fixture(scope="module")
def runs() -> list[Run]:
    return [chosen(COSTS, way, urgency, 5, steps=400) for way in WAYS for urgency in URGENCIES]


def as_records(table: Rows) -> list[dict[str, str]]:
    """As they are read from a file."""
    return records([[str(cell) for cell in row] for row in table])


def plots(figure: Figure) -> Iterator[Axes]:
    """Those that have an axis; the legend has none."""
    return (axes for axes in figure.axes if axes.axison)


def curve(line: Line2D) -> FloatArray:
    """(2, points)."""
    return np.array(line.get_data(), dtype=float)


def bars(axes: Axes) -> list[float]:
    return [patch.get_height() for patch in axes.patches if isinstance(patch, Rectangle)]


def test_rows_are_read_back_as_they_were_stored() -> None:
    for row, again in zip(rows(), miss_rows_of(as_records(miss_table(rows()))), strict=True):
        assert again[:7] == row[:7]
        assert again[7:] == pytest.approx(row[7:], rel=5e-3)


def test_curves_are_the_shares_of_missed_deadlines_in_their_bands() -> None:
    figure = miss_figure(rows())
    assert flaws(figure) == []
    for axes, (urgency, job) in zip(plots(figure), product(URGENCIES, JOBS), strict=True):
        for way, line, band in zip(WAYS, axes.lines, axes.collections, strict=True):
            of_way = [row for row in rows() if (row.way, row.urgency, row.job) == (way.name, urgency, job)]
            np.testing.assert_allclose(curve(line), [GRID, [100 * row.misses / 600 for row in of_way]])
            (corners,) = [path.vertices for path in band.get_paths()]
            edges = {round(float(share), 6) for share in np.asarray(corners)[:, 1]}
            assert {round(100 * limit, 6) for row in of_way for limit in row.interval} == edges


def test_a_curve_may_end_before_the_others() -> None:
    """And there may be none."""
    shorter = [row for row in rows() if row.way != WAYS[0].name and (row.way == WAYS[1].name or row.clock_mhz > 40)]
    assert flaws(miss_figure(shorter)) == []


def test_response_times_are_quantiles(runs: list[Run]) -> None:
    found = responses(runs)
    times = np.array(runs[0].responses_ms["loop"])
    kept = found[f"loop, {runs[0].way}, {runs[0].urgency}"]
    assert len(kept) == len(found["share"]) == LEVELS
    assert kept[0] == times[0]
    for share, time in zip(found["share"], kept, strict=True):
        assert (times > time).mean() <= share <= (times >= time).mean() + 1e-12


def test_response_figure_shows_them(runs: list[Run]) -> None:
    found = responses(runs)
    figure = response_figure(found)
    assert flaws(figure) == []
    for axes, (urgency, job) in zip(plots(figure), product(URGENCIES, JOBS), strict=True):
        for way, line in zip(WAYS, axes.lines, strict=False):
            np.testing.assert_allclose(curve(line), [found[f"{job}, {way.name}, {urgency}"], 100 * found["share"]])


@pytest.mark.exhaust
def test_landings_are_shares_of_all_that_arrived() -> None:
    found = landings([chosen(COSTS, WAYS[2], "preempted", 1000)])
    np.testing.assert_allclose(found[f"GPS, {WAYS[2].name}, preempted"], found["arrivals"], atol=0.3)
    assert found["arrivals"].sum() == pytest.approx(100)


def test_landing_figure_shows_them(runs: list[Run]) -> None:
    found = landings(runs)
    figure = landing_figure(found)
    assert flaws(figure) == []
    first, *_, last = plots(figure)
    assert bars(first) == pytest.approx(list(found[f"GPS, {WAYS[0].name}, preempted"]))
    assert bars(last) == pytest.approx(list(found[f"GPS, {WAYS[2].name}, preempted"]))


def test_figures_say_what_is_what(runs: list[Run]) -> None:
    said = {text.get_text() for text, _ in texts(response_figure(responses(runs)))}
    assert set(WAY_NAMES.values()) <= said
    assert {"Loop: predict, IMU", "Control task", "GPS correction", "deadline"} <= said


def test_verdicts_say_from_which_clock_on_a_processor_holds_and_how_often_it_is_late() -> None:
    """None of 500 fixes: at most 0.8 %. 67 % of 600 steps, as if each of 500 fixes had made one late: Wilson's."""
    table = verdict_rows(rows(), 40)
    assert [row[2] for row in table[1:]] == [1000] * 6
    by_case = {(row[0], row[1]): row for row in table}
    missed = "66.7 (62.4 to 70.7)"
    assert by_case[WAY_NAMES[WAYS[0].name], "in the loop"][3:] == ["20", missed, "57", missed, missed]


def test_a_way_that_was_not_tried_at_that_clock_has_no_verdict() -> None:
    fast = [row for row in rows() if row.clock_mhz > 40 or row.way != WAYS[0].name]
    by_case = {(row[0], row[1]): row for row in verdict_rows(fast, 40)}
    assert by_case[WAY_NAMES[WAYS[0].name], "preempted"][2:] == [1000, *["-"] * 5]


def test_shares_add_up(runs: list[Run]) -> None:
    for row in share_rows(runs)[1:]:
        assert sum(float(cell) for cell in row[3:-1]) == pytest.approx(100, abs=0.4)


def test_charts_of_one_late_fix() -> None:
    """At 5 MHz a step takes 1.2 ms, and the replay of 15 of them 18 ms."""
    preempted, in_the_loop, larsen = panels = fix_panels(COSTS, 5)
    assert flaws(gantt(panels)) == []
    landed = [panel.marks[-1].step for panel in panels]
    assert landed[0] > landed[1] > landed[2] == DELAY
    assert larsen.schedule.misses == 0
    assert in_the_loop.notes[1] != "loop in time" == preempted.notes[1]
    assert [never_ran(panel.schedule) for panel in panels] == [0, 0, 0]
    assert {bar.style for bar in bars_of(preempted.schedule)} == {"PR", "CO", "RP", "CU", "task:control"}
    assert {bar.style for bar in bars_of(larsen.schedule)} == {"PR", "CO", "task:control"}


def test_the_faster_the_processor_the_earlier_the_correction_lands_and_the_label_says_where() -> None:
    frames = fix_frames(COSTS, (2, 5, 10, 1000))
    landed = [frame.label.partition(" = ")[2].split(", ") for frame in frames.values()]
    for clock, frame in frames.items():
        assert frame.label.startswith(f"{clock} MHz: l − k = ")
        assert len(frame.panels) == 3
    for of_way in zip(*landed, strict=True):
        steps = [float("inf") if step == "later" else int(step) for step in of_way]
        assert steps == sorted(steps, reverse=True)
        assert steps[-1] == DELAY
    assert landed[0][0] == "later"


def test_data_of_the_charts_are_their_bars() -> None:
    heading, *body = fix_rows(fix_frames(COSTS, (5,)))
    panels = fix_panels(COSTS, 5)
    assert len(body) == sum(len(bars_of(panel.schedule)) for panel in panels)
    found = [dict(zip(heading, row, strict=True)) for row in body if row[1] == panels[1].title]
    replay = [bar for bar in bars_of(panels[1].schedule) if bar.style == "RP"]
    said = [(float(row["from, steps"]), float(row["to, steps"])) for row in found if row["work"] == "RP"]
    period = panels[1].schedule.period
    np.testing.assert_allclose(said, [(bar.start / period, bar.end / period) for bar in replay], atol=5e-4)
    assert {row["job"] for row in found} == {"loop", "control", "GPS"}
    assert any(row["ends late"] == "yes" for row in found)
