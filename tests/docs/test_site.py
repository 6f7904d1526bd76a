"""The documentation site is built without a warning, loads nothing from elsewhere, and no link in it is dead.

A warning is also that a type of ours in a signature has no entry in docs/reference (`nitpick_ignore` of docs/conf.py:
those that need none).
"""

from __future__ import annotations

import re
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from html.parser import HTMLParser
from importlib import import_module
from pathlib import Path
from urllib.parse import unquote, urlsplit

from tests.docs.test_examples import ROOT

LOADED = {
    "script": "src",
    "img": "src",
    "iframe": "src",
    "source": "src",
    "object": "data",
    "link": "href",
    "use": "href",
}
ELSEWHERE = re.compile(r"(?!data:)\w+:|//")
SPHINX = "import gc, sys; from sphinx.cmd.build import main; gc.disable(); sys.exit(main())"
"""A fifth of its time would go into looking for memory that nobody needs any more."""

PACKAGES = ("sched_sim", "filters", "filters.modular", "studies", "reports")


class Page(HTMLParser):
    """What a page loads, where it links to, what can be linked to in it, what the Tab key stops at, and its text."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.loads: list[str] = []
        self.links: list[str] = []
        self.ids: set[str] = set()
        self.stops: set[str] = set()
        self.text = ""
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attributes}
        self.ids.add(given.get("id", ""))
        if "tabindex" in given:
            self.stops.update([tag, *given.get("class", "").split()])
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        elif tag in LOADED and LOADED[tag] in given and given.get("rel") not in ("index", "search", "next", "prev"):
            self.loads.append(given[LOADED[tag]])

    def handle_data(self, data: str) -> None:
        self.text += data


def build(site: Path) -> dict[Path, Page]:
    options = ["--quiet", "--fail-on-warning", "--nitpicky", "-d", str(site.parent / "doctrees")]
    made = subprocess.run([sys.executable, "-c", SPHINX, *options, str(ROOT / "docs"), str(site)],
                          capture_output=True, text=True)  # fmt: skip
    assert made.returncode == 0, made.stderr
    return {path: Page(path) for path in site.rglob("*.html")}


def from_elsewhere(site: Path, pages: dict[Path, Page]) -> Iterator[str]:
    for path, page in pages.items():
        yield from (f"{path.name}: {load}" for load in page.loads if ELSEWHERE.match(load))
    for path in site.rglob("*.css"):
        for url in re.findall(r"url\(\s*['\"]?([^)'\"]+)|@import\s+['\"]([^'\"]+)", path.read_text(encoding="utf-8")):
            if ELSEWHERE.match("".join(url)):
                yield f"{path.name}: {url}"


def dead_links(pages: dict[Path, Page]) -> Iterator[str]:
    for path, page in pages.items():
        for link in (*page.links, *page.loads):
            url = urlsplit(link)
            target = (path.parent / unquote(url.path)).resolve() if url.path else path
            there = pages[target].ids if target in pages else {unquote(url.fragment)}
            if not url.scheme and not (target.is_file() and unquote(url.fragment) in {*there, ""}):
                yield f"{path.name}: {link}"


def test_the_site_is_whole(tmp_path: Path) -> None:
    site = tmp_path / "site"
    pages = build(site)
    assert list(from_elsewhere(site, pages)) == []
    assert list(dead_links(pages)) == []
    assert set().union(*(page.stops for page in pages.values())) >= {"pre", "table-wrapper", "math"}, "to be scrolled"
    pictures = [(page.links, load) for page in pages.values() for load in page.loads if load.endswith(".svg")]
    assert [picture for links, picture in pictures if picture not in links] == []
    raw = {path.name: re.findall(r"\$\$|\\frac|\\begin|\{eval-rst\}", page.text) for path, page in pages.items()}
    assert not {name: found for name, found in raw.items() if found}
    ids = set().union(*(page.ids for page in pages.values()))
    lacking = defaultdict(list)
    for package in PACKAGES:
        for name in import_module(package).__all__:
            if f"{package}.{name}" not in ids and f"module-{package}.{name}" not in ids:
                lacking[package].append(name)
    assert not lacking, "give it an entry in docs/reference"
