"""Figures on boards: their numbers are those they were given, and they can be read."""

from __future__ import annotations

from functools import cache

import numpy as np
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure

from reports.embedded.board_tables import KB, memory_bytes, timings
from reports.embedded.compared import Compared, compared
from reports.embedded.instructions_figure import instructions_figure
from reports.embedded.least_speed_figure import WITHIN, least_speed_figure
from reports.embedded.memory_figure import PARTS, memory_figure
from reports.embedded.published_figure import LINES as WAYS
from reports.embedded.published_figure import grouped, published_figure
from reports.embedded.results import Results, read
from reports.embedded.tables import per_operation
from reports.embedded.words import CORES, LINES
from studies.embedded.sources import FIRST, FORMS
from tests.reports import published
from tests.reports.layout import flaws, texts


@cache
def stored() -> Results:
    return read(published.FOLDER / "embedded")


@cache
def found() -> list[Compared]:
    return compared(stored())


@cache
def speeds() -> Figure:
    return least_speed_figure(found())


def test_least_speeds() -> None:
    assert flaws(speeds()) == []
    for axes, form in zip(speeds().axes, FORMS, strict=False):
        for source, line in LINES.items():
            of = [one for one in found() if (one.form, one.source) == (form, source)]
            drawn = [one for one in axes.lines if one.get_color() == line.colour]
            signs = [float(one.get_xdata()[0]) for one in drawn if one.get_marker() == line.marker]
            first = [100 * float(one.deviation) for one in of if one.timing == FIRST]
            np.testing.assert_allclose(signs, first)
            ends = [x for one in drawn if one.get_marker() != line.marker for x in map(float, one.get_xdata())]
            np.testing.assert_allclose(
                [min(ends), max(ends)], [f(100 * float(one.deviation) for one in of) for f in (min, max)]
            )


def test_nothing_lies_beyond_the_axes() -> None:
    furthest = max(abs(100 * float(one.deviation)) for one in found() if one.source in LINES)
    for axes in speeds().axes[:2]:
        low, high = axes.get_xlim()
        assert low == -high
        assert high > max(furthest, WITHIN)


def test_the_counted_speed_stands_beside_each_row() -> None:
    shown = [text.get_text() for text, _ in texts(speeds())]
    for form in FORMS:
        assert {f"{float(one.counted):.2f}" for one in found() if (one.form, one.timing) == (form, FIRST)} <= set(shown)


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
    signs = [line for line in figure.axes[0].lines if line.get_linestyle() == "None"]
    rows = grouped(timings())
    assert [tuple(map(float, line.get_xdata())) for line in signs] == [tuple(map(float, of.ratios)) for _, of in rows]
    assert [line.get_color() for line in signs] == [WAYS[of.written].colour for _, of in rows]


def test_memory() -> None:
    memory = {core: memory_bytes(stored(), core, "textbook") for core in ("cortex-m4f", "cortex-m7")}
    figure = memory_figure(memory)
    assert flaws(figure) == []
    for axes, of in zip(figure.axes, memory.values(), strict=False):
        drawn = sum(bar.get_width() for bar in axes.patches) * KB
        np.testing.assert_allclose(drawn, sum(sum(parts.values()) for parts in of.values()))


def test_flash_is_not_stacked_on_ram() -> None:
    memory = {core: memory_bytes(stored(), core, "textbook") for core in ("cortex-m4f", "cortex-m7")}
    for axes, of in zip(memory_figure(memory).axes, memory.values(), strict=False):
        flash = [bar for bar in axes.patches if bar.get_facecolor() == to_rgba(PARTS["code"][0])]
        assert [(bar.get_x(), bar.get_width() * KB) for bar in flash] == [(0, parts["code"]) for parts in of.values()]


def test_logarithmic_axes_say_that_they_are() -> None:
    for figure in (instructions_figure(per_operation(stored()), 3.5), published_figure(timings(), 1.5)):
        for axes in figure.axes:
            if axes.get_xlabel():
                assert (axes.get_xscale() == "log") == ("logarithmic" in axes.get_xlabel())


def test_every_source_and_every_way_to_write_code_has_a_sign_of_its_own() -> None:
    for lines in (LINES, WAYS):
        assert len({(line.colour, line.marker) for line in lines.values()}) == len(lines)
        assert len({line.marker for line in lines.values()}) == len(lines)
    assert {line.colour for line in LINES.values()} & {line.colour for line in WAYS.values()} <= {LINES["numba"].colour}
