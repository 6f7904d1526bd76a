"""What every published report must hold to: it is rebuilt byte for byte, opens offline, and the command writes it."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Collection, Mapping
from pathlib import Path

from reports.pages import made
from reports.pages.machine import MARK
from tests.command_line import Run

FOLDER = Path(__file__).parents[2] / "reports" / "published"

Files = Mapping[str, bytes]


def names(report: str) -> list[str]:
    """Of the files that are committed, but for the one that says when and where they were made."""
    return sorted(path.name for path in (FOLDER / report).iterdir() if path.name != made.FILE)


def is_rebuilt(report: str, name: str, files: Files) -> None:
    """files: what the code makes of the report."""
    written = made.with_made(files, made.made_of(FOLDER / report))
    assert written[name] == (FOLDER / report / name).read_bytes()


def is_complete(report: str, files: Files) -> None:
    """No file too many or too few."""
    assert names(report) == sorted(files)


def is_self_contained(files: Files) -> None:
    """Every figure is in the page, and nothing is fetched."""
    page = files["index.html"].decode()
    figures = [name for name in files if name.endswith(".svg")]
    assert figures
    assert len(re.findall(r'<svg class="f\d+" role="img"', page)) == len(figures)
    assert not re.findall(r'(?:src|href)="(?:https?:)?//', page)


def is_written(report: str, files: Files, sched_sim: Run, folder: Path) -> None:
    """By the command, run in `folder`; what takes long must be replaced before."""
    result = sched_sim(f"report {report} -o here")
    assert (result.code, result.out) == (0, "")
    there = folder / "here" / report
    said = made.made_of(there)
    assert said is not None
    assert {path.name: path.read_bytes() for path in there.iterdir()} == made.with_made(files, said)


def differs_only_where_marked(files: Files, others: Files, figures: Collection[str], mark: str = MARK) -> None:
    """Between two machines: as `is_unchanged_where_unmarked`, and something does differ."""
    assert is_unchanged_where_unmarked(files, others, figures, mark)


def is_unchanged_where_unmarked(files: Files, others: Files, figures: Collection[str], mark: str = MARK) -> list[str]:
    """Between two machines: in tables only columns whose heading has the mark differ, in the text only paragraphs that
    have it, and these figures; the paragraphs that do. What is stored may differ as it likes."""
    for name, content in files.items():
        if name.endswith(".csv") and not name.startswith("stored-"):
            heading = next(csv.reader(io.StringIO(content.decode())))
            kept = [number for number, head in enumerate(heading) if mark not in head]
            assert not kept or _picked(content, kept) == _picked(others[name], kept)
        elif name.endswith(".svg") and name not in figures:
            assert content == others[name]
    before, after = (re.split(r"\n\n", one["index.md"].decode()) for one in (files, others))
    changed = [one for one, two in zip(before, after, strict=True) if one != two]
    assert all(mark in paragraph for paragraph in changed)
    return changed


def text(files: Files) -> str:
    """The report in one line."""
    return " ".join(files["index.md"].decode().split())


def rows(files: Files, name: str) -> list[dict[str, str]]:
    """A table, its rows by their heading."""
    return list(csv.DictReader(io.StringIO(files[name].decode())))


def _picked(content: bytes, kept: list[int]) -> list[list[str]]:
    return [[row[number] for number in kept] for row in csv.reader(io.StringIO(content.decode()))]
