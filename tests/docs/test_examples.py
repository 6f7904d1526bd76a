"""What the README and every page of the documentation show is run, page by page, in an empty folder, in its order.

A `toml` or `python` block whose first line is the comment of a file name is that file. Other `python` blocks are run,
with the names of those before; a `text` block behind one is what it prints. In a `console` block the lines behind a
`$ sched-sim` are what it prints, in a `sh` block each line is a command; so is one with a design in a sentence.
"""

from __future__ import annotations

import contextlib
import io
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from markdown_it import MarkdownIt

from tests.c_compiler import has_c
from tests.command_line import Run

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
INSTALLS = ("make ", "pip ", "pipx ", "uv ")  # and what they do is tested elsewhere


def blocks(page: Path) -> Iterator[tuple[str, str]]:
    """Language and text of each block of code, and of each command within a sentence."""
    for token in MarkdownIt("commonmark").enable("table").parse(page.read_text(encoding="utf-8")):
        if token.type == "fence":
            yield token.info, token.content
        for part in token.children or []:
            if part.type == "code_inline" and re.match(r"sched-sim \w+ -N (?!.*\.\.\.)", part.content):
                yield "sh", part.content


def lines(text: str) -> list[str]:
    return [line.rstrip() for line in text.splitlines() if line.strip()]


def run_python(source: str, names: dict[str, object]) -> str:
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(source, "example", "exec"), names)
    return printed.getvalue()


@pytest.fixture(autouse=True)
def folder_of_modules(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The user's modules are found in the current folder, and forgotten again."""
    before = set(sys.modules)
    monkeypatch.syspath_prepend(tmp_path)
    yield
    for name in set(sys.modules) - before:
        if (getattr(sys.modules[name], "__file__", None) or "").startswith(str(tmp_path)):
            del sys.modules[name]


@pytest.fixture(autouse=True)
def explorers_end_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """And open no browser."""
    monkeypatch.setattr("reports.explorer.serve.serve", lambda _app, _there: None)
    monkeypatch.setattr("sched_sim.cli.explore.open_browser", lambda _address: None)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_a_page_does_as_it_shows(page: Path, sched_sim: Run) -> None:
    def do(command: str) -> str:
        result = sched_sim(command.removeprefix("sched-sim ").partition(" #")[0])
        assert result.code == 0, f"{command}\n{result.err}"
        return result.out

    names: dict[str, object] = {}
    printed = ""
    for language, text in blocks(page):
        if named := re.match(r"# ([\w-]+\.(?:toml|py))\n", text):
            Path(named[1]).write_text(text, encoding="utf-8")
        elif language == "python":
            assert not printed, f"what was printed is not shown: {printed}"
            printed = run_python(text, names)
        elif language == "text" and printed:
            assert lines(printed) == lines(text)
            printed = ""
        elif language == "console":
            for example in text.split("$ ")[1:]:
                command, _, shown = example.partition("\n")
                assert lines(do(command)) == lines(shown)
        elif language == "sh":
            for command in text.splitlines():
                if command.startswith("sched-sim "):
                    if "--backend c " not in command or has_c():
                        do(command)
                else:
                    assert command.startswith(INSTALLS), command
        else:
            assert language in ("", "text", "toml") or language.startswith("{"), language  # Sphinx runs a directive
    assert not printed, f"what was printed is not shown: {printed}"
