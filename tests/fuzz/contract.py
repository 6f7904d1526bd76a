"""What every command line of `sched-sim` keeps, whatever it is given.

Exit code 0; or 2 with a message on standard error that names the option or the file, nothing on standard output and
nothing written (a sweep may keep its results file). Never a traceback or a warning, never a character that a terminal
obeys. What was there stays as it was; what is written is whole.
"""

from __future__ import annotations

import csv
import io
import json
import os
import re
import signal
import sys
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from tempfile import TemporaryDirectory
from types import FrameType
from unittest.mock import patch
from xml.etree import ElementTree

from sched_sim.cli import main
from tests.command_line import Result
from tests.fuzz.cases import OUTPUT_OPTIONS, Case

MOST_CPU_S = 60
"""Of processor time, which no load of the machine uses up: what is within all bounds takes a few at the most."""

NAMES = re.compile(
    r"-{1,2}[A-Za-z]|\.toml|\.py|cost table|processor|picture|file|scenario|command|argument|[NML]=|\[\w+"
)


class Hang(BaseException):
    """More than MOST_CPU_S."""


def check(case: Case) -> None:
    """Raises AssertionError where the contract is broken."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        _fill(folder, case)
        before = _contents(folder)
        result = _run(folder, case)
        after = _contents(folder)
    said = f"{case.arguments}\n{result.out[-3000:]}\n{result.err[-6000:]}"
    if not case.arguments:
        return
    assert result.code in (0, 2), said
    assert "Traceback" not in result.err, said
    assert "Warning" not in result.err, said
    assert not _obeyed(result.out + result.err), said
    named = _outputs(case) if result.code == 0 else ()
    assert all(after.get(path) == content for path, content in before.items() if path not in named), said
    new = {path: content for path, content in after.items() if path not in before and not path.endswith(".pyc")}
    if result.code == 2:
        assert not result.out, said
        assert NAMES.search(result.err), said
        assert all((content or b"").startswith(b"SQLite") or ".sqlite" in path for path, content in new.items()), said
    else:
        _is_printed_whole(case, result.out, said)
        for path, content in new.items():
            _is_whole(path, content, said)


def _outputs(case: Case) -> list[str]:
    """What the arguments name to be written."""
    following = zip(case.arguments, case.arguments[1:], strict=False)
    return [os.path.normpath(value) for option, value in following if option in OUTPUT_OPTIONS]


def _fill(folder: Path, case: Case) -> None:
    """The case's files, and some that are none."""
    named = " ".join(case.arguments) + " ".join(map(repr, case.files.values()))
    for name, content in case.files.items():
        (folder / name).write_bytes(content)
    if "folder.toml" in named:
        (folder / "folder.toml").mkdir()
    if "loop.toml" in named:
        (folder / "loop.toml").symlink_to("loop.toml")
    if "fifo.toml" in named:
        os.mkfifo(folder / "fifo.toml")
    if "empty.toml" in named:
        (folder / "empty.toml").touch()
    if "latin.toml" in named:
        (folder / "latin.toml").write_bytes(b'name = "\xe9"')
    if "deep.toml" in named:
        (folder / "deep.toml").write_text("a = " + "[" * 3000 + "]" * 3000)


def _contents(folder: Path) -> dict[str, bytes | None]:
    """Of all regular files; None for the others."""
    return {
        os.fspath(path.relative_to(folder)): path.read_bytes() if path.is_file() else None
        for path in folder.rglob("*")
        if path.name != "__pycache__"
    }


def _run(folder: Path, case: Case) -> Result:
    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8", write_through=True) for _ in range(2))
    home = Path.cwd()
    code = 0
    try:
        os.chdir(folder)
        with (
            patch.object(sys, "argv", ["sched-sim", *case.arguments]),
            patch("studies.sweep.workers._Team", side_effect=OSError),  # no processes
            patch("reports.explorer.serve.serve"),  # nothing is waited for
            redirect_stdout(out),
            redirect_stderr(err),
            _bounded(),
        ):
            main()
    except SystemExit as stop:
        code = int(stop.code or 0)
    finally:
        os.chdir(home)
    return Result(code, *(stream.buffer.getvalue().decode() for stream in (out, err)))  # type: ignore[attr-defined]


@contextmanager
def _bounded() -> Iterator[None]:
    def stop(_number: int, _frame: FrameType | None) -> None:
        raise Hang

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, MOST_CPU_S)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def _obeyed(text: str) -> bool:
    """Whether a terminal would do something for it."""
    return any(not character.isprintable() for character in text.replace("\n", ""))


def _is_printed_whole(case: Case, out: str, said: str) -> None:
    line = " ".join(case.arguments)
    if "help" in line or "version" in line or out.startswith((" Usage", "Usage")):
        return
    last = next((argument for argument in reversed(case.arguments) if argument in ("json", "csv", "table")), "")
    if last == "json" and out and "--format json" in line:
        assert out.lstrip()[0] in "[{", said
        json.loads(out, parse_constant=_no_number)
    if last == "csv" and out and "--format csv" in line:
        assert len({len(row) for row in csv.reader(io.StringIO(out))}) == 1, said


def _no_number(text: str) -> float:
    raise AssertionError(f"{text} is no JSON")


def _is_whole(path: str, content: bytes | None, said: str) -> None:
    """By what it is: any name will do for a cost table and for the results of a sweep."""
    assert content is not None, said
    if content.startswith(b"<?xml"):
        ElementTree.fromstring(content)
    elif content.startswith(b"\x89PNG"):
        assert content.endswith(b"IEND\xaeB`\x82"), said
    elif content.startswith(b"%PDF"):
        assert content.rstrip().endswith(b"%%EOF"), said
    elif content.startswith(b"PAR1"):
        assert content.endswith(b"PAR1"), said
    elif content.startswith(b"{"):
        json.loads(content, parse_constant=_no_number)
    elif content.startswith(b"name = "):
        tomllib.loads(content.decode())
    elif not (content.startswith(b"SQLite format 3") or path.endswith(("-wal", "-shm", "-lock"))):
        assert len({len(row) for row in csv.reader(io.StringIO(content.decode()))}) == 1, said
