"""Figures on boards: their numbers are those they were given, and they can be read."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache

import numpy as np
import pytest
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure

from reports.drawing.style import Line
from reports.embedded.answer_figure import answer_figure, rows_of
from reports.embedded.board_tables import KB, memory_bytes, timings, whole_bytes
from reports.embedded.compared import Compared, compared
from reports.embedded.instructions_figure import instructions_figure
from reports.embedded.least_speed_figure import WITHIN, least_speed_figure
from reports.embedded.memory_figure import PARTS, memory_figure
from reports.embedded.published_figure import LINES as WAYS
from reports.embedded.published_figure import grouped, published_figure
from reports.embedded.results import Results, read
from reports.embedded.tables import per_operation
from reports.embedded.words import CORES, LINES, OTHERS, PAPERS
from studies.embedded.sources import FIRST, FORMS
from studies.measurement.published_timings import published_timings
from tests.reports import published
from tests.reports.explorer.test_palette import contrast, luminance
from tests.reports.layout import flaws, texts


@cache
def stored() -> Results:
    return read(published.FOLDER / "embedded")


@cache
def found() -> list[Compared]:
    return compared(stored())


def of_methods(methods: Sequence[str]) -> list[Compared]:
    return [one for one in found() if one.method in methods]


@cache
def speeds(methods: Sequence[str]) -> Figure:
    return least_speed_figure(of_methods(methods))


@pytest.mark.parametrize("methods", [PAPERS, OTHERS])
def test_least_speeds(methods: Sequence[str]) -> None:
    assert flaws(speeds(methods)) == []
    for axes, form in zip(speeds(methods).axes, FORMS, strict=False):
        for source, line in LINES.items():
            of = [one for one in of_methods(methods) if (one.form, one.source) == (form, source)]
            drawn = [one for one in axes.lines if one.get_color() == line.colour]
            signs = [float(one.get_xdata()[0]) for one in drawn if one.get_marker() == line.marker]
            first = [100 * float(one.deviation) for one in of if one.timing == FIRST]
            np.testing.assert_allclose(signs, first)
            ends = [x for one in drawn if one.get_marker() != line.marker for x in map(float, one.get_xdata())]
            np.testing.assert_allclose(
                [min(ends), max(ends)], [f(100 * float(one.deviation) for one in of) for f in (min, max)]
            )


@pytest.mark.parametrize("methods", [PAPERS, OTHERS])
def test_nothing_lies_beyond_the_axes(methods: Sequence[str]) -> None:
    furthest = max(abs(100 * float(one.deviation)) for one in of_methods(methods) if one.source in LINES)
    for axes in speeds(methods).axes[:2]:
        low, high = axes.get_xlim()
        assert low == -high
        assert high > max(furthest, WITHIN)


@cache
def answer() -> Figure:
    return answer_figure(rows_of(found(), published_timings()))


def test_the_figure_of_the_answer_leaves_room_on_the_first_screen_and_is_read_on_a_phone() -> None:
    assert flaws(answer()) == []
    across, down = map(float, answer().get_size_inches())
    assert down / across <= 95 / 170
    assert across * 25.4 <= 110


def test_the_figure_of_the_answer_has_all_that_is_compared() -> None:
    (axes,) = answer().axes
    signs = {
        str(line.get_label()): list(map(float, line.get_xdata())) for line in axes.lines if line.get_marker() != "None"
    }
    emulated = [1 + float(one.deviation) for one in found() if one.source in CORES]
    assert signs["four emulated cores"] == pytest.approx([min(emulated), max(emulated)])
    ends = [end for of in signs.values() for end in of]
    low, high = axes.get_xlim()
    assert low < min(ends) < max(ends) < high
    ways = [float(ratio) for timing in published_timings() for ratio in timing.ratios]
    assert {min(ways), max(ways)} <= set(ends)


@pytest.mark.parametrize("methods", [PAPERS, OTHERS])
def test_the_counted_speed_stands_beside_each_row(methods: Sequence[str]) -> None:
    shown = {text.get_text() for text, _ in texts(speeds(methods))}
    of_first = [one for one in of_methods(methods) if one.timing == FIRST]
    assert {f"{float(one.counted):.2f}" for one in of_first} <= shown


def test_instructions_for_each_operation() -> None:
    of = per_operation(stored())
    figure = instructions_figure(of, 3.5)
    assert flaws(figure) == []
    for column, form in enumerate(FORMS):
        points = [
            (float(x), float(y))
            for axes in (figure.axes[column], figure.axes[column + 2])
            for line in axes.lines
            if line.get_linestyle() == "None"
            for x, y in zip(line.get_xdata(), line.get_ydata(), strict=True)
        ]
        assert sorted(points) == sorted(point for core in CORES for point in of[form][core])


def test_published_timings() -> None:
    figure = published_figure(timings(), 1.5)
    assert flaws(figure) == []
    numbers = [box for text, box in texts(figure) if re.fullmatch(r"[\d.]+ to [\d.]+|\d\.\d\d", text.get_text())]
    right = figure.axes[0].get_window_extent().x1
    assert len([box for box in numbers if box.x0 >= right]) == len(timings()), "no line crosses a number"
    signs = [line for line in figure.axes[0].lines if line.get_linestyle() == "None"]
    rows = grouped(timings())
    assert [tuple(map(float, line.get_xdata())) for line in signs] == [tuple(map(float, of.ratios)) for _, of in rows]
    assert [line.get_color() for line in signs] == [WAYS[of.written].colour for _, of in rows]


def by_task() -> dict[str, dict[str, dict[str, int]]]:
    return {core: memory_bytes(stored(), core, "textbook") for core in ("cortex-m4f", "cortex-m7")}


@pytest.mark.parametrize("whole", [True, False], ids=["whole", "by task"])
def test_memory(*, whole: bool) -> None:
    memory = whole_bytes(stored()) if whole else by_task()
    figure = memory_figure(memory)
    assert flaws(figure) == []
    for axes, of in zip(figure.axes, memory.values(), strict=False):
        drawn = sum(bar.get_width() for bar in axes.patches) * KB
        np.testing.assert_allclose(drawn, sum(sum(parts.values()) for parts in of.values()))
        flash = [bar for bar in axes.patches if bar.get_facecolor() == to_rgba(PARTS["code"].colour)]
        assert [bar.get_x() for bar in flash] == [0] * len(of), "flash is not stacked on RAM"
        assert [round(bar.get_width() * KB) for bar in flash] == [parts["code"] for parts in of.values()]


def test_parts_of_memory_differ_without_colour() -> None:
    parts = [fill for part, fill in PARTS.items() if part != "ram"]
    assert len({(fill.hatch, round(luminance(fill.colour), 1)) for fill in parts}) == len(parts)
    for fill in parts:
        assert max(contrast(fill.colour, "white"), contrast(fill.ink, "white") if fill.edge_pt else 1) >= 3


def test_logarithmic_axes_say_that_they_are() -> None:
    for figure in (instructions_figure(per_operation(stored()), 3.5), published_figure(timings(), 1.5)):
        for axes in figure.axes:
            if axes.get_xlabel():
                assert (axes.get_xscale() == "log") == ("logarithmic" in axes.get_xlabel())


@pytest.mark.parametrize("lines", [LINES, WAYS], ids=["sources", "ways"])
def test_every_source_and_every_way_to_write_code_has_a_sign_of_its_own(lines: Mapping[str, Line]) -> None:
    assert len({line.marker for line in lines.values()}) == len(lines)
    assert len({line.colour for line in lines.values()}) == len(lines)
    assert min(contrast(line.colour, "white") for line in lines.values()) >= 3


def test_where_two_cores_lie_on_one_another_both_are_seen() -> None:
    """They take the same instructions."""
    below, above = LINES["cortex-m4f"], LINES["cortex-m33"]
    assert above.size < 0.7 * below.size
    assert contrast(below.colour, above.colour) >= 3


def test_ways_to_write_code_do_not_look_like_sources() -> None:
    assert not {line.colour for line in LINES.values()} & {line.colour for line in WAYS.values()}
