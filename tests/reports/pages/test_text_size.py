"""Readers who have set a larger text size in their browser get all of a page in it, and nothing beyond its edge."""

from __future__ import annotations

from importlib.resources import files

import pytest

from tests.browser import Visit

STYLE = files("reports").joinpath("templates/page.css").read_text()
TEXT = """<h1>A delayed-measurement Kalman filter</h1>
<p>On <span class="day">2026-11-29</span>, by <code><span class="word">max-completely-peel-times-of-all=8</span></code>.
<figure><figcaption>What is drawn. <span class="files">
<a href="#">stored-rocket-residual-course-of-all-flights.csv</a></span></figcaption></figure>"""


@pytest.fixture
def larger(visit: Visit) -> Visit:
    visit.page.set_viewport_size({"width": 320, "height": 640})
    visit.page.set_content(f"<!doctype html><style>{STYLE} html {{font-size: 150%}}</style><main>{TEXT}</main>")
    return visit


def test_text_is_as_large_as_the_reader_has_set(larger: Visit) -> None:
    assert larger.page.evaluate("getComputedStyle(document.querySelector('p')).fontSize") == "24px"


def test_no_word_name_or_file_is_beyond_the_edge_of_a_narrow_page(larger: Visit) -> None:
    assert larger.page.evaluate("document.documentElement.scrollWidth") <= 320
