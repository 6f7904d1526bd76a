"""Figures of the paper's claims can be read and show what was computed; what is said of waiting holds beyond them."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure

from reports.drawing.style import METHOD_LINES, Line
from reports.steffes import processors, waiting
from reports.steffes.agreement import ZERO, agreement_figure
from reports.steffes.figures import achieved_figure, least_speed_figure
from reports.steffes.noise import noise_figure
from reports.steffes.processors import (
    SWITCHES,
    landings,
    processors_figure,
    steps_of,
    switched,
    switches_figure,
    variants,
)
from reports.steffes.products import products_figure
from reports.steffes.waiting import by_wait, off_the_curve, waited, waiting_figure
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import achieved_l, least_speed
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.timing import Timing
from studies.steffes.agreement import Agreement
from studies.steffes.noise import Approximated
from studies.steffes.products import STEPS, Multiplies
from tests.reports.layout import flaws, texts

PAPER, COUNTED = load_costs("steffes2014"), load_costs("counted-9-3-3").normalised()
DUAL_RATE = select(PAPER, "dual-rate")
assert isinstance(DUAL_RATE, DualRateCosts)
T = Timing(10, 4, 8)
WAITING = np.array([4 <= j % 10 < 8 for j in range(21)])
AGREED = Agreement(
    T,
    {method: np.where(WAITING, 0.1, 2e-16) for method in ("larsen", "recalculate")},
    {method: np.array([0.0, 1e-16, 2e-16]) for method in ("larsen", "recalculate")},
    WAITING,
)
COUNTS = [Multiplies(n, dict(zip(STEPS, (2 * n**3, 3 * n**3, 3 * n**3, n**3, n**3), strict=True))) for n in (3, 9)]
NOISES = [
    Approximated(system, noise, share, share, share**2 / 100)
    for system in ("turning", "inertial")
    for noise in ("sum", "euler")
    for share in (0.01, 0.5)
]


def curves(figure: Figure, label: str) -> list[list[float]]:
    return [list(line.get_ydata()) for axes in figure.axes for line in axes.lines if line.get_label() == label]


@pytest.mark.parametrize(
    "figure",
    [
        agreement_figure(AGREED),
        products_figure(COUNTS),
        noise_figure(NOISES),
        waiting_figure(PAPER),
        processors_figure(landings(COUNTED, T), T),
        switches_figure({method: [Fraction(1), *SWITCHES[1:]] for method in ("larsen", "dual-rate")}),
    ],
    ids=["agreement", "products", "noise", "waiting", "processors", "switches"],
)
def test_figures_can_be_read(figure: Figure) -> None:
    assert flaws(figure) == []
    assert all(axes.get_xlabel() for axes in figure.axes if axes.axison)


@pytest.mark.parametrize(
    "figure",
    [agreement_figure(AGREED), waiting_figure(PAPER), least_speed_figure(PAPER), achieved_figure(PAPER)],
    ids=["agreement", "waiting", "least speed", "achieved"],
)
def test_no_formula_has_a_halo_which_in_a_pdf_would_cover_the_letters_before_it(figure: Figure) -> None:
    assert not [text.get_text() for text, _ in texts(figure) if "$" in text.get_text() and text.get_path_effects()]


def test_no_difference_at_all_is_drawn_at_the_zero_of_the_axis() -> None:
    figure = agreement_figure(AGREED)
    assert curves(figure, "Larsen, P at k") == [[ZERO, 1e-16, 2e-16]]
    (states,) = curves(figure, "Recalculate, state")
    assert [value > 1e-3 for value in states] == WAITING.tolist()


def test_products_are_drawn_in_units_of_n_cubed() -> None:
    figure = products_figure(COUNTS)
    assert curves(figure, "Standard (no delay)") == [[2.0, 2.0]]
    assert curves(figure, "Larsen") == curves(figure, "Dual-rate") == [[3.0, 3.0]]


def test_errors_by_approximate_noise_are_drawn_as_they_are() -> None:
    assert curves(noise_figure(NOISES), "Q″, inertial") == [[0.01, 0.5], [1e-6, 0.0025]]


@given(st.integers(3, 60), st.data())
def test_from_m_2_on_least_speed_depends_on_l_minus_m_alone(N: int, data: st.DataObject) -> None:
    M = data.draw(st.integers(2, N - 1))
    L = data.draw(st.integers(M + 1, N))
    assert least_speed(DUAL_RATE, Timing(N, M, L)).speed == by_wait(DUAL_RATE, L - M)


def test_the_designs_off_the_curve_are_those_with_m_1() -> None:
    found = waited(PAPER)
    assert {one.timing for one in off_the_curve(found, PAPER)} == {one.timing for one in found if one.timing.M == 1}


def test_variants_are_what_the_analysis_gives_each() -> None:
    by_name = {one.name: one for one in variants(COUNTED, T)}
    two = Options(cpus=2)
    assert by_name["two CPUs"].speed == least_speed(select(COUNTED, "dual-rate", two), T, two).speed
    assert by_name["one CPU"].lands == by_name["one CPU"].beside == 8
    assert by_name["one CPU"].speed > by_name["one CPU, early gain"].speed > by_name["two CPUs"].speed


def test_with_an_early_gain_it_lands_at_lower_speeds_too_if_lr_propagate_may_end_after_m() -> None:
    """As the caption of the figure says: the curve begins below the least speed of the table."""
    early = Options(gain="precomputed")
    by_m = least_speed(select(COUNTED, "dual-rate", early), T, early)
    by_l = least_speed(select(COUNTED, "dual-rate", early), T, replace(early, lr_propagate_by="l"))
    assert by_m.binding == "lr_propagate"
    assert by_l.speed < by_m.speed
    landed = achieved_l(select(COUNTED, "dual-rate", early), T, by_l.speed, early)
    assert landed is not None
    assert landed <= T.L


def test_what_is_listed_of_landings_is_what_is_drawn() -> None:
    landed = landings(COUNTED, T)
    figure = processors_figure(landed, T)
    for number, (name, curve) in enumerate(landed.items()):
        assert curves(figure, name) == [[L - 0.09 * number for _, L in curve]]
        steps = steps_of(curve)
        assert [L for _, L in steps] == sorted({L for _, L in curve}, reverse=True)
        for speed, L in steps:
            assert speed == min(other for other, at in curve if at == L)


@pytest.mark.parametrize("lines", [waiting.LINES, processors.LINES], ids=["waiting", "processors"])
def test_designs_of_the_dual_rate_filter_do_not_look_like_another_method(lines: dict[str, Line]) -> None:
    others = {METHOD_LINES[name].colour for name in ("standard", "recalculate", "larsen")}
    assert others.isdisjoint({line.colour for line in lines.values()})
    assert len({line.marker for line in lines.values()}) == len(lines)


def test_switches_cost_larsen_one_a_step_and_dual_rate_two() -> None:
    speeds = switched(PAPER, T)
    for method, switches in (("larsen", 1), ("dual-rate", 2)):
        assert [speed - speeds[method][0] for speed in speeds[method]] == [switches * cost for cost in SWITCHES]
