"""The HTML of a report's Markdown: headings that can be linked to, tables that scroll, figures with their captions."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from html import unescape
from itertools import count
from typing import NamedTuple

from markdown_it import MarkdownIt

from reports.pages import alive
from reports.pages.inline import inline
from reports.pages.numbers import unbroken
from reports.pages.pictures import Picture

FIGURE = re.compile(
    r'<p><img src="(?P<file>[^":]+\.svg)" alt="(?P<alt>[^"]*)" /></p>\n'
    r"<p><strong>Figure (?P<number>\d+)\.</strong> (?P<caption>(?:(?!</p>).)*) "
    r"<em>(?P<links>(?:(?!</?em>).)*)</em></p>",
    re.DOTALL,
)
HEADING = re.compile(r"<h([23])>(.*?)</h\1>")
TABLE = re.compile(r"<table>.*?</table>", re.DOTALL)
ROW_NAME = re.compile(r"<tr>\s*<td[^>]*>(.*?)</td>", re.DOTALL)
HEAD = re.compile(r"<th\b.*?</th>", re.DOTALL)
LONG_NAME, LONG_HEAD = 18, 14
"""Letters: rows with such names, and columns with such headings, have more room for them, where the page is narrow."""
MENTION = re.compile(r"(<[^>]*>)|\bFigure (\d+)\b(?!\.<)")
ANSWER = "<p><strong>Answer.</strong>"


class Heading(NamedTuple):
    """id: of its element; text: as HTML, without elements."""

    level: int
    id: str
    text: str


class Body(NamedTuple):
    """lead: down to the first heading of a section; rest: from there."""

    lead: str
    rest: str
    headings: tuple[Heading, ...]


def body_of(markdown: str, figures: Mapping[str, Picture]) -> Body:
    """figures: by file name."""
    html = unbroken(MarkdownIt("commonmark", {"html": True}).enable("table").render(markdown))
    html = MENTION.sub(lambda found: found[1] or f'<a href="#figure-{found[2]}">{found[0]}</a>', html)
    html = FIGURE.sub(lambda found: _captioned(figures[found["file"]], found), html)
    html = html.replace(ANSWER, ANSWER.replace("<p>", '<p class="answer">'), 1)
    headings = tuple(_headings(html))
    named = iter(headings)
    html = HEADING.sub(lambda found: _named(next(named), found[2]), html)
    lead, mark, rest = html.partition("<h2 ")
    return Body(_scrolling(lead), _scrolling(mark + rest), headings)


def _captioned(picture: Picture, found: re.Match[str]) -> str:
    number, caption, links = found["number"], found["caption"], found["links"]
    alt = unescape(found["alt"])
    if picture.narrow is None:
        still, data = alive.picture(inline(picture.svg, f"f{number}", alt)), picture.alive
    else:
        still = alive.picture(inline(picture.svg, f"f{number}", alt), "ss-wide")
        still += alive.picture(inline(picture.narrow.svg, f"n{number}", alt), "ss-narrow")
        data = {**(picture.alive or {}), "narrow": picture.narrow.alive}
    text = f'<figcaption><b>Figure {number}.</b> {caption} <span class="files">{links}</span></figcaption>'
    return alive.figure(still, data, caption=text, attributes=f' id="figure-{number}"')


def _headings(html: str) -> Iterator[Heading]:
    """No two have one id."""
    taken: set[str] = set()
    for level, inner in HEADING.findall(html):
        text = _text(inner)
        name = re.sub(r"\W+", "-", unescape(text).lower()).strip("-")
        while name in taken:
            name += "-"
        taken.add(name)
        yield Heading(int(level), name, text)


def _named(heading: Heading, inner: str) -> str:
    return f'<h{heading.level} id="{heading.id}">{inner}</h{heading.level}>'


def _scrolling(html: str) -> str:
    """Tables that are wider than the page scroll, and keys reach them; each is named after the heading above it, and
    numbered where there are several."""
    return "".join(map(_of_section, re.split(r"(?=<h[23] )", html)))


def _of_section(html: str) -> str:
    heading = re.match(r"<h[23] .*?>(.*?)</h[23]>", html)
    of = "" if heading is None else f": {_text(heading[1])}"
    numbers = count(1)
    several = len(TABLE.findall(html)) > 1

    def reached(table: re.Match[str]) -> str:
        label = f"Table {next(numbers)}{of}" if several else f"Table{of}"
        long = any(len(_text(name)) >= LONG_NAME for name in ROW_NAME.findall(table[0]))
        shown = "table long-names" if long else "table"
        text = HEAD.sub(_with_room, table[0])
        return f'<div class="{shown}" role="group" tabindex="0" aria-label="{label}">{text}</div>'

    return TABLE.sub(reached, html)


def _with_room(head: re.Match[str]) -> str:
    return head[0].replace("<th", '<th class="long"', 1) if len(_text(head[0])) >= LONG_HEAD else head[0]


def _text(html: str) -> str:
    return re.sub(r"<.*?>", "", html)
