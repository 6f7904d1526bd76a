"""`sched-sim report`: what is written where, one report or all, and what is left when one of them fails."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from sched_sim.cli.progress import Progress
from tests.command_line import Run, is_refused

PAGE = b"<main>\n</main>\n"


def made(name: str) -> Callable[[bool, Progress], dict[str, bytes]]:
    def report(_thorough: bool, progress: Progress) -> dict[str, bytes]:
        progress(1, 2, "half of it")
        return {"index.html": PAGE, "index.md": f"# On {name}\n\n**Answer.** It is {name}.\n".encode()}

    return report


def broken(_thorough: bool, _progress: Progress) -> dict[str, bytes]:
    raise ZeroDivisionError("nothing to divide by")


def stopped(_thorough: bool, _progress: Progress) -> dict[str, bytes]:
    raise KeyboardInterrupt


@pytest.fixture
def reports(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    def replace(**others: Callable[[bool, Progress], dict[str, bytes]]) -> None:
        """Three reports, of which these are others."""
        three: Mapping[str, Callable[[bool, Progress], dict[str, bytes]]] = {
            name: made(name) for name in ("accuracy", "modular", "erkf")
        }
        monkeypatch.setattr("sched_sim.cli.report.REPORTS", {**three, **others})
        monkeypatch.setattr("sched_sim.cli.report.monotonic", lambda: 0.0)

    replace()
    return replace


def written(folder: Path) -> list[str]:
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


@pytest.mark.usefixtures("reports")
def test_one_report_stands_beside_the_page_of_all_and_says_where_it_is(sched_sim: Run, tmp_path: Path) -> None:
    result = sched_sim("report modular")
    there = tmp_path / "build/reports"
    assert written(there) == [
        "index.html", "index.md", "modular/index.html", "modular/index.md", "modular/made.toml",
    ]  # fmt: skip
    assert "build/reports/modular/index.html" in result.err
    assert "all reports: build/reports/index.html" in result.err
    assert "It is modular." in (there / "index.md").read_text()
    sched_sim("report accuracy")
    assert [name in (there / "index.md").read_text() for name in ("On accuracy", "On modular")] == [True, True]


@pytest.mark.usefixtures("reports")
def test_all_of_them_and_how_long_each_took_and_will_take(sched_sim: Run, tmp_path: Path) -> None:
    first = sched_sim("report --all -o new")
    assert (first.code, first.out) == (0, "")
    assert len(written(tmp_path / "new")) == 2 + 3 * 3
    for name in ("accuracy", "modular", "erkf"):
        assert f"{name}: less than 1 s, new/{name}/index.html" in first.err
    assert "Wrote 3 reports in less than 1 s: new/index.html" in first.err
    (tmp_path / "new/modular/made.toml").write_text(
        (tmp_path / "new/modular/made.toml").read_text().replace("seconds = 0.0", "seconds = 125")
    )
    again = sched_sim("report --all -o new")
    assert again.err.startswith(
        "3 reports, about 2 min 5 s by their last runs: accuracy less than 1 s, modular 2 min 5 s,"
    )


@pytest.mark.usefixtures("reports")
def test_what_is_damaged_of_the_last_run_is_made_anew(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "new/erkf").mkdir(parents=True)
    (tmp_path / "new/erkf/index.md").write_bytes(b"\xff")
    (tmp_path / "new/erkf/made.toml").write_text("seconds = ")
    assert sched_sim("report modular -o new").code == 0
    assert "its made.toml cannot be read" in (tmp_path / "new/index.md").read_text()
    assert sched_sim("report --all -o new").code == 0
    assert "cannot be read" not in (tmp_path / "new/index.md").read_text()


def test_an_error_of_one_does_not_lose_the_others(sched_sim: Run, tmp_path: Path, reports: Callable[..., None]) -> None:
    reports(modular=broken)
    result = sched_sim("report --all -o new")
    is_refused(result, ["modular: not made: nothing to divide by", "1 of 3 reports", "`sched-sim report modular`"])
    assert {name.partition("/")[0] for name in written(tmp_path / "new")} == {
        "index.html", "index.md", "accuracy", "erkf",
    }  # fmt: skip


def test_when_it_is_stopped_what_is_done_is_there(sched_sim: Run, tmp_path: Path, reports: Callable[..., None]) -> None:
    reports(modular=stopped)
    result = sched_sim("report --all -o new")
    assert result.code == 130
    assert "accuracy: less than 1 s" in result.err
    assert "It is accuracy." in (tmp_path / "new/index.md").read_text()
    assert not (tmp_path / "new/modular").exists()
    assert "what is done is in new" in result.err


def test_when_the_first_is_stopped_nothing_is_said_to_be_done(
    sched_sim: Run, tmp_path: Path, reports: Callable[..., None]
) -> None:
    reports(accuracy=stopped)
    assert sched_sim("report --all -o new").err.endswith("nothing of before is lost\n")
    assert written(tmp_path / "new") == []


@pytest.mark.usefixtures("reports")
def test_where_no_page_can_be_written_another_folder_is_asked_for(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "erkf" / "index.html").mkdir(parents=True)
    is_refused(sched_sim("report erkf -o ."), ["--output: 'erkf/index.html'", "give a folder"])


@pytest.mark.usefixtures("reports")
def test_one_and_all_is_refused_and_so_is_to_replace_a_page_of_yours(sched_sim: Run, tmp_path: Path) -> None:
    is_refused(sched_sim("report erkf --all"), ["erkf and --all", "leave out one of them"])
    (tmp_path / "index.html").write_text("mine")
    is_refused(sched_sim("report erkf -o ."), ["--output '.'", "index.html", "give another folder"])
    assert written(tmp_path) == ["index.html"]


def test_help_says_what_each_report_is_about(sched_sim: Run) -> None:
    from sched_sim.cli.report import REPORTS

    said = " ".join(sched_sim("report --help").out.replace("\N{BOX DRAWINGS LIGHT VERTICAL}", " ").split())
    for name in REPORTS:
        assert f"{name}, which" in said or f"{name}: " in said
    assert "--all" in said
