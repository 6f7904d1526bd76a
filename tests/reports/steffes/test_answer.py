"""The answer, in words and as bars whose numbers can be read on a phone."""

from __future__ import annotations

import re
from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from reports.steffes.answer import LARGE_PT, SHEET_MM, answer_figure, answer_rows
from sched_sim.design.timing import Timing
from tests.reports import published
from tests.reports.layout import flaws, texts
from tests.reports.steffes.page import of_table_4, rebuilt

T = Timing(10, 4, 8)
HUNDREDTHS = {"standard": 100, "recalculate": 281, "larsen": 147, "dual-rate": 77}
SPEEDS = {method: Fraction(speed, 100) for method, speed in HUNDREDTHS.items()}


def test_it_says_how_fast_and_how_late_each_method_is() -> None:
    figure = answer_figure(SPEEDS, T)
    assert flaws(figure) == []
    said = [text.get_text() for text, _ in texts(figure)]
    assert {"2.81", "1.47", "0.77", "corrects 4 steps later", "Standard (no delay): 1"} <= set(said)
    assert said.count("corrects on arrival") == 2
    assert [bar.get_width() for bar in figure.axes[0].patches] == [2.81, 1.47, 0.77]
    assert answer_rows(SPEEDS, T)[-1] == ["Dual-rate", 8, "0.770"]


def test_texts_are_legible_on_a_phone_of_320_pixels_between_margins() -> None:
    assert LARGE_PT / 72 * 25.4 / SHEET_MM * 320 > 8.5


@given(st.fractions(Fraction(1, 2), Fraction(5, 4), max_denominator=100))
def test_no_number_stands_on_the_line(speed: Fraction) -> None:
    figure = answer_figure({**SPEEDS, "dual-rate": speed}, T)
    level = figure.axes[0].transData.transform((1, 0))[0]
    (box,) = [box for text, box in texts(figure) if text.get_text() == f"{float(speed):.2f}"]
    assert not box.x0 < level < box.x1


def test_the_answer_is_short_and_that_of_table_4() -> None:
    answer = published.text(rebuilt()).partition("**Answer.**")[2].partition(" ![")[0]
    assert len(answer.split()) <= 50
    least = {
        row["Method"]: float(row["analysis"])
        for row in published.rows(rebuilt(), "table-4.csv")
        if row["N, M, L"] == "10, 4, 8"
    }
    assert f"{least['Dual-rate']:.2f} against {least['Larsen']:.2f} (without delays: 1)" in answer
    assert f"{100 * least['Dual-rate'] / least['Larsen']:.0f} % of Larsen's processor speed" in answer


def test_as_many_speeds_are_below_what_costs_give_as_is_said() -> None:
    low = [1 - float(row["printed"]) / float(row["analysis"]) for row in of_table_4() if row["reached"] == "no"]
    assert f"{len(low)} are {100 * min(low):.0f} to {100 * max(low):.0f} % below" in published.text(rebuilt())


def test_the_first_figure_and_its_caption_fit_the_first_screen() -> None:
    """A figure is 736 pixels wide on a screen; title and answer take some 220 of its 900, three lines of text 70."""
    figures = re.findall(r"!\[[^\]]*\]\(([^)]+)\)\n\n(.*)", rebuilt()["index.md"].decode())
    assert figures[0][0] == "answer.svg"
    width, height = map(float, size_of("answer.svg"))
    assert 736 * height / width < 320
    assert len(figures[0][1]) < 450


def size_of(name: str) -> tuple[str, str]:
    (found,) = re.findall(r'<svg[^>]* width="([\d.]+)pt" height="([\d.]+)pt"', rebuilt()[name].decode())
    return found


def test_the_first_figure_shows_the_speeds_of_the_first_design() -> None:
    rows = {row["Method"]: row["least speed"] for row in published.rows(rebuilt(), "answer.csv")}
    assert rows.pop("Standard (no delay)") == "1.000"
    assert rows == {row["Method"]: row["analysis"] for row in of_table_4() if row["N, M, L"] == "10, 4, 8"}


def test_what_is_found_is_said_in_short() -> None:
    short = published.text(rebuilt()).partition("**In short.**")[2].partition(" ## ")[0]
    assert len(short.split()) < 250
