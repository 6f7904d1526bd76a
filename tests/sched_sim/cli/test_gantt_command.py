"""`gantt`: how wide the picture is, the stretch of steps that it shows, and its axis in ms."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.command_line import Run, is_refused
from tests.svg import texts_of

AXIS = "time (ms), HR loop at 400 Hz"
DESIGN = "gantt -N 10 -M 4 -L 8"


def width_mm(picture: Path) -> float:
    (found,) = re.findall(r'<svg [^>]*?width="([\d.]+)pt"', picture.read_text())
    return float(found) / 72 * 25.4


@pytest.mark.parametrize(
    ("width", "expected"),
    [("88mm", 88), ("180", 180), pytest.param("3.5in", 88.9, marks=pytest.mark.exhaust), (" 7/2 in", 88.9)],
)
def test_a_picture_is_as_wide_as_is_asked(sched_sim: Run, tmp_path: Path, width: str, expected: float) -> None:
    assert sched_sim(f"{DESIGN} --width '{width}' -o g.svg").code == 0
    assert width_mm(tmp_path / "g.svg") == pytest.approx(expected)


def test_by_default_it_is_as_wide_as_the_text_of_a_page(sched_sim: Run, tmp_path: Path) -> None:
    sched_sim(f"{DESIGN} -o a.svg")
    sched_sim(f"{DESIGN} -o b.svg --width 170mm --from 0 --until 10")
    assert [width_mm(tmp_path / name) for name in ("a.svg", "b.svg")] == pytest.approx([170, 170])
    assert "all 10 steps" in texts_of(tmp_path / "b.svg")
    assert "all 10 steps" not in texts_of(tmp_path / "a.svg")
    assert AXIS not in texts_of(tmp_path / "a.svg")


def test_a_stretch_may_be_in_steps_or_in_ms(sched_sim: Run, tmp_path: Path) -> None:
    """At 400 Hz a step is 2.5 ms: 9 ms is within step 3, and step 8 is the first that starts at 18 ms or later."""
    for file, stretch in (("a.svg", "--from 3 --until 8"), ("b.svg", "--from 9ms --until 18ms")):
        assert sched_sim(f"{DESIGN} --hr-hz 400 {stretch} -o {file}").code == 0
    assert (tmp_path / "a.svg").read_text() == (tmp_path / "b.svg").read_text()
    assert "steps 3 to 7 of 10" in texts_of(tmp_path / "a.svg")
    assert AXIS in texts_of(tmp_path / "a.svg")


def test_hr_hz_adds_an_axis_in_ms_to_the_picture_of_a_simulation_too(sched_sim: Run, tmp_path: Path) -> None:
    sched_sim("simulate -N 10 -M 4 --hr-hz 400 --gantt c.svg")
    assert AXIS in texts_of(tmp_path / "c.svg")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ("--width 0", ["--width 0 is narrower", "50mm to 1000mm"]),
        ("--width=-88mm", ["--width -88mm is narrower"]),
        ("--width abc", ["--width 'abc' is no length", "88mm or 3.5in"]),
        ("--width mm", ["--width 'mm' is no length"]),
        ("--width nan", ["--width 'nan' is no length"]),
        ("--width 1e99999999", ["--width '1e99999999' is no length"]),
        ("--width 40in", ["--width 40in is wider"]),
        ("--from 8 --until 5", ["--until 5 is not after --from 8"]),
        ("--from 5 --until 5", ["--until 5 is not after --from 5"]),
        ("--until 0", ["--until 0 is not after the start"]),
        ("--from 10", ["--from 10 is beyond the end: 10 steps are simulated", "--cycles"]),
        ("--until 11", ["--until 11 is beyond the end: 10 steps are simulated", "--cycles"]),
        ("--until 26ms --hr-hz 400", ["--until 26ms is beyond the end: 10 steps, 25 ms, are simulated"]),
        ("--from 10ms", ["--from 10ms is a time", "--hr-hz"]),
        ("--from abc", ["--from 'abc' is no step", "10ms"]),
        ("--from 1.5", ["--from 1.5 is no whole step"]),
        ("--from=-1", ["--from -1 is before the first step"]),
    ],
)
def test_what_cannot_be_drawn_is_refused(sched_sim: Run, tmp_path: Path, options: str, words: list[str]) -> None:
    result = sched_sim(f"{DESIGN} {options}")
    is_refused(result, words)
    assert result.err.count("Error:") == 1
    assert not list(tmp_path.iterdir())


def test_what_times_became_in_steps_is_said_line_by_line(sched_sim: Run) -> None:
    result = sched_sim("gantt --hr-hz 400 --measurement-hz 5 --delay-ms 110 --method larsen -o g.svg")
    assert result.err == "5 Hz: N = 80 steps\n110 ms late: M = 44 steps\nWrote g.svg\n"


def test_each_method_is_simulated_as_far_as_the_picture_goes(sched_sim: Run, tmp_path: Path) -> None:
    """Larsen's correction is in the state by step 26, the dual-rate one must be by 40."""
    line = "gantt -N 10 -M 25 -L 40 --costs counted-9-3-3"
    assert sched_sim(f"{line} --from 20 --until 34 -o g.svg").code == 0
    texts = " ".join(texts_of(tmp_path / "g.svg"))
    assert texts.count("steps 20 to 33 of") == 2
    is_refused(sched_sim(f"{line} --until 41 -o g.svg"), ["--until 41 is beyond the end", "40 steps are simulated"])
