"""What differs from one making of a report to the next: beside it, in the last line of its page, and read back."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.pages.made import FILE, Made, made_here, made_of, with_made
from reports.pages.numbers import duration
from sched_sim.errors import InputError

FILES = {"index.html": b"<main>says </main> in a script, and ends</main>\n", "index.md": b"# A report\n"}
TEXT = st.text(st.characters(codec="utf-8", exclude_categories=("C", "Zl", "Zp")))
MADE = st.builds(
    Made, TEXT, TEXT, st.dictionaries(TEXT, TEXT, min_size=1), st.integers(0, 10**6).map(lambda tenths: tenths / 10)
)


@given(MADE)
def test_what_is_written_is_read_back(made: Made) -> None:
    with TemporaryDirectory() as name:
        folder = Path(name)
        (folder / FILE).write_bytes(with_made(FILES, made)[FILE])
        assert made_of(folder) == made


@given(MADE)
def test_the_page_says_it_at_its_end_and_nothing_else_changes(made: Made) -> None:
    files = with_made(FILES, made)
    assert sorted(files) == sorted([*FILES, FILE])
    assert files["index.md"] == FILES["index.md"]
    before, footer, after = files["index.html"].decode().partition("<footer")
    assert f"{before}</main>{after.partition('</main>')[2]}".encode() == FILES["index.html"]
    said = unescape(footer + after)
    how = "stored results" if made.seconds is None else duration(made.seconds)
    assert all(word in said for word in (made.date, made.machine, how, *made.versions.values()))


def test_the_page_leads_to_all_data_and_to_each_file_once() -> None:
    page = b'<main><a href="late.csv">late.csv</a></main>'
    files = {"index.html": page, "late.csv": b"", "costs.csv": b"", "measured.toml": b"", "late.svg": b""}
    text = with_made(files, made_here(None))["index.html"].decode()
    assert re.findall('href="(.*?)"', text) == ["late.csv", FILE, "costs.csv", "measured.toml"]


def test_of_a_report_that_nobody_wrote_it_down_of_nothing_is_said(tmp_path: Path) -> None:
    assert made_of(tmp_path) is None
    assert with_made(FILES, None) == FILES


def test_a_file_that_is_broken_is_named(tmp_path: Path) -> None:
    (tmp_path / FILE).write_text("date = ")
    with pytest.raises(InputError, match=r"made.toml is not valid TOML"):
        made_of(tmp_path)
    (tmp_path / FILE).write_text('date = "2026-11-29"')
    with pytest.raises(InputError, match=r"made.toml .*anew"):
        made_of(tmp_path)


@pytest.mark.parametrize("seconds", ["nan", "-1", "true", '"long"', "1e300"])
def test_what_is_no_duration_is_named(tmp_path: Path, seconds: str) -> None:
    (tmp_path / FILE).write_text(f'date = "2026-11-29"\nmachine = "here"\nseconds = {seconds}\n[versions]\n')
    with pytest.raises(InputError, match=r"made.toml: seconds is "):
        made_of(tmp_path)


def test_here_it_is_this_machine_by_these_versions() -> None:
    made = made_here(12.34)
    assert made.machine
    assert set(made.versions) == {"sched_sim", "python", "numpy", "numba"}
    assert made.seconds == 12.3


@pytest.mark.parametrize(
    ("seconds", "said"), [(0.9, "less than 1 s"), (41.4, "41 s"), (59.6, "1 min 0 s"), (200, "3 min 20 s")]
)
def test_how_long_in_words(seconds: float, said: str) -> None:
    assert duration(seconds) == said
