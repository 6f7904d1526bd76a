"""What a person gives to drawing functions: panels, widths, files."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from reports import gantt, method_panel, save
from reports.drawing.picture import image
from sched_sim import InputError, Timing, load_costs, select, simulate

TABLE, TIMING = load_costs("steffes2014"), Timing(10, 4, 8)
PANEL = method_panel(TABLE, "dual-rate", TIMING, Fraction(4, 5))


@pytest.mark.parametrize("speed", [0.8, "0.8", "4/5", Fraction(4, 5)], ids=repr)
def test_a_speed_is_what_it_writes(speed: Any) -> None:
    assert method_panel(TABLE, "dual-rate", TIMING, speed) == PANEL


def test_panels_are_one_or_any_number() -> None:
    expected = image(gantt([PANEL]), "svg")
    assert image(gantt(PANEL), "svg") == expected
    assert image(gantt(panel for panel in [PANEL]), "svg") == expected


@pytest.mark.parametrize("width_mm", [50, 1000, "170"])
def test_widths(width_mm: Any) -> None:
    assert gantt(PANEL, width_mm=width_mm).get_figwidth() * 25.4 == pytest.approx(float(width_mm))


BAD: dict[str, tuple[Callable[[], Any], str]] = {
    "speed": (lambda: method_panel(TABLE, "dual-rate", TIMING, 0), "speed is 0: it must be greater than 0"),
    "cycles": (lambda: method_panel(TABLE, "dual-rate", TIMING, 1, 0), "cycles is 0: give at least 1"),
    "no panels": (lambda: gantt([]), "panels is empty: give at least one"),
    "None": (lambda: gantt(None), "panels holds None: give method_panel(...)"),  # type: ignore[arg-type]
    "text": (lambda: gantt("larsen"), "panels holds 'l': give method_panel(...)"),  # type: ignore[arg-type]
    "a schedule": (
        lambda: gantt(simulate(select(TABLE, "dual-rate"), TIMING, 1)),  # type: ignore[arg-type]
        "panels holds Schedule(",
    ),
    "narrow": (lambda: gantt(PANEL, width_mm=49), "width_mm is 49: give from 50 to 1000"),
    "wide": (lambda: gantt(PANEL, width_mm="1e6"), "width_mm is 1e+06: give from 50 to 1000"),  # type: ignore[arg-type]
    "no width": (lambda: gantt(PANEL, width_mm=None), "width_mm is 'None': give a finite number"),  # type: ignore[arg-type]
    "no rate": (lambda: gantt(PANEL, hr_hz=0), "hr_hz is 0: it must be greater than 0"),
    "first": (lambda: method_panel(TABLE, "dual-rate", TIMING, 1, first=10), "first is 10: give at most 9"),
    "last": (lambda: method_panel(TABLE, "dual-rate", TIMING, 1, last=11), "last is 11: give at most 10"),
    "order": (
        lambda: method_panel(TABLE, "dual-rate", TIMING, 1, first=5, last=5),
        "first is 5 and last is 5: the first step is 0 or later, and before the last",
    ),
    "no step": (lambda: method_panel(TABLE, "dual-rate", TIMING, 1, first=0.5), "first is 0.5: give a whole number"),  # type: ignore[arg-type]
    "swapped": (lambda: save("a.svg", gantt(PANEL)), "figure is a str: give save(figure, path)"),  # type: ignore[arg-type]
    "no path": (lambda: save(gantt(PANEL), None), "path is a NoneType: give save(figure, path)"),  # type: ignore[arg-type]
}


@pytest.mark.parametrize("case", BAD)
def test_errors_name_the_argument(case: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    call, message = BAD[case]
    with pytest.raises(InputError) as caught:
        call()
    assert message in str(caught.value)
