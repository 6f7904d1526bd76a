"""Figures on accuracy: their numbers are those they were given, and they can be read."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from matplotlib.figure import Figure

from filters.accuracy import lossless
from reports.accuracy.figures import SLOWEST, landing_figure, slow_figure
from reports.accuracy.front_figure import LARGER, LINES, SHADE, SHADE_PT, front_figure
from reports.accuracy.lead_figure import lead_figure
from reports.pages.numbers import significant
from sched_sim.costs.methods import DELAYED_METHODS
from studies.accuracy.given import MODELS, given
from studies.accuracy.landing import Landing, landing
from studies.accuracy.scale import SUMMED, Placed, cheapest, counted, scale
from studies.accuracy.slow_processor import at_speeds, choices
from tests.reports.explorer.test_palette import contrast
from tests.reports.layout import flaws, texts


@cache
def landings() -> list[Landing]:
    return [landing(given(name)) for name in MODELS]


@cache
def placed(name: str) -> list[Placed]:
    """With a smoothed output that is far off."""
    of = given(name)
    exact = lossless(of.model, of.states, of.N, of.M)
    return scale(of, counted(of), exact._replace(total=20 * exact.total))


def test_landings() -> None:
    figure = landing_figure(landings())
    assert flaws(figure) == []
    for axes, found in zip(figure.axes[:4], landings(), strict=True):
        curves = [line for line in axes.lines if len(line.get_xdata()) > 2]
        assert len(curves) == len(found.curves)
        for line, curve in zip(curves, found.curves.values(), strict=True):
            shown = curve.worst[: 2 * found.given.N - found.given.M + 1]
            np.testing.assert_allclose(line.get_ydata(), 100 * (shown / found.no_delay - 1))
            assert line.get_xdata()[0] == found.given.ms(found.given.M)
            assert line.get_xdata()[-1] == found.given.ms(2 * found.given.N)


def test_the_answer() -> None:
    found = dict(zip(MODELS, landings(), strict=True))
    figure = lead_figure(found)
    assert flaws(figure) == []
    across, down = map(float, figure.get_size_inches())
    assert down / across <= 95 / 170, "of the first screen"
    assert across * 25.4 <= 110, "letters that are read on a phone"
    drawn = {line.get_label(): line.get_xdata() for line in figure.axes[0].lines}
    waiting = [100 * landing.waiting for landing in found.values()]
    np.testing.assert_allclose(drawn["every fix, landing at the next one"], waiting)
    np.testing.assert_allclose(
        drawn["every 2nd fix, on arrival"], [100 * landing.leaving_out(2) for landing in found.values()]
    )


@cache
def front() -> Figure:
    return front_figure({name: placed(name) for name in MODELS})


@pytest.mark.exhaust
def test_power_against_accuracy() -> None:
    assert flaws(front()) == []
    for axes, name in zip(front().axes[:4], MODELS, strict=True):
        least = cheapest(placed(name))
        points = {at for line in axes.lines for at in zip(line.get_xdata(), line.get_ydata(), strict=True)}
        for method in ("clone", "larsen", "dual-rate", SUMMED, "delayed-horizon"):
            place = least[method]
            assert (float(place.speed), 100 * place.accuracy.over_no_delay) in points
        assert any(line.get_xdata()[0] == float(least["standard"].speed) for line in axes.lines)


def test_the_designs_that_none_beats_are_a_stair() -> None:
    for axes, name in zip(front().axes[:4], MODELS, strict=True):
        (stair,) = [line for line in axes.lines if line.get_color() == SHADE]
        best = sorted((float(place.speed), place.accuracy.over_no_delay) for place in placed(name) if place.on_front)
        np.testing.assert_allclose(stair.get_xdata()[:-1], [speed for speed, _ in best])
        np.testing.assert_allclose(stair.get_ydata()[:-1], [100 * over for _, over in best])


def test_what_lies_beyond_the_axes_is_at_the_edge_with_its_number() -> None:
    shown = {text.get_text() for text, _ in texts(front())}
    for axes, name in zip(front().axes[:4], MODELS, strict=True):
        for method in ("px4-predictor", "fuse-as-fresh"):
            over = 100 * cheapest(placed(name))[method].accuracy.over_no_delay
            assert (f"{significant(over)} % ↑" in shown) == (over > axes.get_ylim()[1])
        for line in axes.lines:
            if line.get_transform() == axes.transData:
                low, high = axes.get_xlim()
                assert all(low <= x <= high for x in line.get_xdata())


def test_no_number_of_what_lies_beyond_is_crossed_by_the_power_of_the_standard_filter() -> None:
    for axes, name in zip(front().axes[:4], MODELS, strict=True):
        standard, _ = axes.transData.transform((float(cheapest(placed(name))["standard"].speed), 0))
        numbers = [box for text, box in texts(front()) if text in axes.texts and text.get_text().endswith(" % ↑")]
        assert numbers
        assert not any(box.x0 < standard < box.x1 for box in numbers)


def test_no_arrow_head_looks_like_the_sign_of_a_method() -> None:
    assert not [text for axes in front().axes for text in axes.texts if getattr(text, "arrow_patch", None)]


def test_the_line_of_the_best_hides_no_sign_and_is_in_the_legend_as_it_is_drawn() -> None:
    drawn = [line for axes in front().axes for line in axes.lines if line.get_color() == SHADE]
    assert {line.get_linewidth() for line in drawn} == {SHADE_PT}
    assert len(drawn) == len(MODELS) + 1
    assert 0.4 * LARGER * min(line.size for line in LINES.values()) > SHADE_PT


def test_every_method_has_a_line_of_its_own() -> None:
    assert set(LINES) == {*DELAYED_METHODS, SUMMED}
    looks = [(line.colour, line.marker) for line in LINES.values()]
    assert len(set(looks)) == len(looks)
    assert len({line.marker for line in LINES.values()}) == len(looks)


def test_the_slow_processor() -> None:
    figure = slow_figure(choices())
    assert flaws(figure) == []
    axes = figure.axes[0]
    assert axes.get_title(loc="left")
    stairs = [line for line in axes.lines if len(line.get_xdata()) > 2]
    assert len(stairs) == 2
    best = {float(speed): pair for speed, pair in at_speeds(choices()).items()}
    for number, line in enumerate(stairs):
        drawn = dict(zip(map(float, line.get_xdata()), map(float, line.get_ydata()), strict=True))
        for speed, pair in best.items():
            if speed >= SLOWEST and (choice := pair[number]) is not None:
                assert drawn[speed] == pytest.approx(1000 * choice.worst)
    assert {"n = 1", "n = 2"} <= {text.get_text() for text, _ in texts(figure)}
    assert all(contrast(text.get_color(), "white") >= 4.5 for text in axes.texts)
    left = axes.get_window_extent().x0
    assert all(box.x0 >= left for text, box in texts(figure) if text.get_text().startswith("n = "))
