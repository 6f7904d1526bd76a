"""Data in a page: whole, whatever names there are in it, and no markup."""

from __future__ import annotations

import json
from html.parser import HTMLParser

from hypothesis import example, given
from hypothesis import strategies as st

from reports.pages.alive import figure, script, style

SMALL = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(10**9), 10**9)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=8,
)


class Read(HTMLParser):
    """The elements that begin, and the text of the scripts."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.elements: list[str] = []
        self.script = ""
        self.feed(html)
        self.close()

    def handle_starttag(self, tag: str, attrs: object) -> None:  # noqa: ARG002
        self.elements.append(tag)

    def handle_data(self, data: str) -> None:
        self.script += data


@given(st.dictionaries(st.text(), SMALL, max_size=3))
@example({"name": "</script><img src=x onerror=alert(1)>"})
@example({"name": "<!--<script>\ud800"})
def test_what_is_told_is_read_back_and_ends_no_element(data: dict[str, object]) -> None:
    html = figure('<img src="data:,">', data)
    assert html.encode("ascii")
    read = Read(html)
    assert read.elements == ["figure", "img", "script"]
    assert json.loads(read.script) == data


def test_a_figure_that_tells_nothing_is_its_picture() -> None:
    assert figure('<img src="data:,">', None) == '<figure class="ss-figure"><img src="data:,"></figure>'


def test_a_page_grows_by_less_than_100_kb() -> None:
    assert len((script() + style()).encode()) < 100_000
