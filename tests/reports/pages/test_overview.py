"""The page of all reports says of each what its own files say."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe

from reports.pages.made import Made, made_of, with_made
from reports.pages.overview import check_overview, overview
from sched_sim.errors import InputError
from tests.browser import Visit
from tests.reports.published import FOLDER

SVG = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 20"><path d="M0 0 L60 20" stroke="#000"/></svg>'
MADE = Made("2026-11-29", "A <fast> machine", {"python": "3.11.7"}, 83.0)
ANSWER = "**Answer.** It needs *half* of what\nanother needs, \N{LESS-THAN OR EQUAL TO} 0.77."


def report(folder: Path, name: str, text: str, made: Made | None = None) -> None:
    (folder / name).mkdir()
    files = with_made({"index.md": text.encode(), "index.html": b"<main></main>", "lead.svg": SVG}, made)
    for file, content in files.items():
        (folder / name / file).write_bytes(content)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    report(tmp_path, "second", f"# Which & why\n\n{ANSWER}\n\n![it is half](lead.svg)\n\n![more](b.svg)\n", MADE)
    report(tmp_path, "first", "# A plain one\n\nNo answer.\n")
    report(tmp_path, "unknown", "# Of no order\n")
    return tmp_path


def texts(folder: Path) -> tuple[str, str]:
    files = overview(folder, ["first", "absent", "second"])
    assert sorted(files) == ["index.html", "index.md"]
    return files["index.html"].decode(), files["index.md"].decode()


def test_title_answer_first_figure_and_making_of_each_in_their_order(folder: Path) -> None:
    html, markdown = texts(folder)
    for text in (html, markdown):
        assert 0 < text.index("A plain one") < text.index("Which &")
        assert "Of no order" not in text
        assert "2026-11-29" in text
        assert "1 min 23 s" in text.replace("\N{NO-BREAK SPACE}", " ")
        assert "report second" in text
    assert '<a href="second/index.html">Which &amp; why</a>' in html
    assert "It needs <em>half</em> of what another needs" in html
    assert "A &lt;fast&gt; machine" in html
    assert html.count("<svg ") == html.count("<title>it is half</title>") == 1
    assert "## [Which & why](second/index.md)\n\nIt needs *half* of what another" in markdown
    assert "[![it is half](second/lead.svg)](second/index.md)" in markdown


def test_a_figure_whose_file_is_gone_is_left_out(folder: Path) -> None:
    (folder / "second" / "lead.svg").unlink()
    html, markdown = texts(folder)
    assert "<svg" not in html
    assert "lead.svg" not in markdown


@pytest.mark.parametrize("damage", [b"", b"\xff\xfe not text", b"<svg/>"])
@pytest.mark.parametrize("file", ["made.toml", "lead.svg", "index.md"])
def test_a_damaged_file_of_one_hides_nothing_of_the_others(folder: Path, file: str, damage: bytes) -> None:
    (folder / "second" / file).write_bytes(damage)
    for text in texts(folder):
        assert "A plain one" in text
        assert "report second" in text
        assert ("its made.toml cannot be read" in text) is (file == "made.toml")


def test_a_title_is_text_whatever_it_holds(folder: Path) -> None:
    (folder / "second" / "index.md").write_text(f"# <script>alert()</script>\n\n{ANSWER}\n")
    assert "<script>" not in texts(folder)[0]


@pytest.mark.parametrize("file", ["made.toml", "lead.svg", "index.md"])
def test_nor_does_a_folder_in_its_place(folder: Path, file: str) -> None:
    (folder / "second" / file).unlink()
    (folder / "second" / file).mkdir()
    assert all("A plain one" in text for text in texts(folder))


def test_it_is_a_function_of_the_folder(folder: Path) -> None:
    assert texts(folder) == texts(folder)
    assert "Reports" in texts(folder / "first")[0]


def test_it_replaces_itself_and_nothing_of_yours(folder: Path) -> None:
    check_overview(folder)
    for name, content in overview(folder, ["first"]).items():
        (folder / name).write_bytes(content)
    check_overview(folder)
    (folder / "index.html").write_text("<title>My own page</title>")
    with pytest.raises(InputError, match=r"index.html' is there and is no page of reports.*another folder"):
        check_overview(folder)


def test_a_folder_in_its_place_is_refused_before_anything_is_made(folder: Path) -> None:
    (folder / "index.md").mkdir()
    with pytest.raises(InputError, match=r"index.md' is there and is no page of reports.*another folder"):
        check_overview(folder)


def test_no_rule_of_accessible_pages_is_broken_and_a_phone_shows_it_whole(visit: Visit, folder: Path) -> None:
    (folder / "index.html").write_text(texts(folder)[0])
    page = visit.page
    page.goto((folder / "index.html").as_uri())
    assert [rule["id"] for rule in Axe().run(page).response["violations"]] == []
    page.set_viewport_size({"width": 360, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= 360
    page.get_by_role("link", name="it is half").click()
    assert page.url == (folder / "second" / "index.html").as_uri()


def test_the_published_one_is_rebuilt_byte_for_byte() -> None:
    from sched_sim.cli.report import REPORTS

    for name, content in overview(FOLDER, REPORTS).items():
        assert (FOLDER / name).read_bytes() == content, "python -m tests.reports.rebuild"


def test_all_published_reports_answer_in_at_most_50_words_and_say_when_they_were_made() -> None:
    """Numbers and units of one letter are no words."""
    text = (FOLDER / "index.md").read_text(encoding="utf-8")
    for part in text.split("\n## ")[1:]:
        _, answer, *_ = part.split("\n\n")
        assert 10 < len(re.findall(r"[^\W\d_]{2,}", answer)) <= 50, answer
    assert [path for path in FOLDER.iterdir() if path.is_dir() and made_of(path) is None] == []
