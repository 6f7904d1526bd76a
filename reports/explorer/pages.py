"""The explorer's pages: one frame, and what it says of each."""

from __future__ import annotations

from string import Template
from typing import NamedTuple

from reports.explorer.module import asset


class Page(NamedTuple):
    """script: the path that it has its script from, which begins with the module `entry`; place: the name of the
    attribute by which the script finds where to draw. title, heading: as text; lead, instead: as HTML, the latter for
    those who have switched scripts off."""

    path: str
    script: str
    entry: str
    place: str
    title: str
    heading: str
    lead: str
    instead: str

    def html(self) -> str:
        return Template(asset("page.html")).substitute(self._asdict())

    def is_asked_by(self, path: str) -> bool:
        return path.startswith(f"{self.path.rstrip('/')}/")


DESIGNS = Page(
    "/",
    "/explorer.js",
    "page",
    "explorer",
    "Explore designs",
    "Which filter, on which part, landing when?",
    "Say what you have and what you need; all else follows at once.",
    "<code>sched-sim design --help</code> answers the same questions in a terminal.",
)
SCENARIO = Page(
    "/scenario",
    "/scenario.js",
    "scenario",
    "scenario",
    "Explore a scenario",
    "How often is it late, and what happens then?",
    'One run of the scenario: how its times are spread, and its trace. <a href="/">One filter\'s designs</a>',
    "<code>sched-sim simulate --scenario FILE --histogram FILE.svg</code> says and draws the same.",
)
