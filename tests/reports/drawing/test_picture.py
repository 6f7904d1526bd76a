"""Pictures as files: the same bytes every time, and errors that say what to do."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
import pytest
from matplotlib.figure import Figure

from reports.charts.chart import gantt, method_panel
from reports.drawing.picture import image, save
from reports.steffes.timelines import dual_rate_timeline
from sched_sim.costs.table_file import load_costs
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.ticks import exact
from tests.svg import texts


def picture() -> Figure:
    return dual_rate_timeline(load_costs("steffes2014"), Timing(10, 4, 8), exact("0.78", "speed"))


def chart() -> Figure:
    """A Gantt chart with a miss: hatches, outlines, red."""
    panels = [method_panel(load_costs("steffes2014"), "dual-rate", Timing(10, 4, 8), exact("0.64", "speed"))]
    return gantt(panels)


@pytest.mark.parametrize("kind", ["svg", "pdf", "png"])
def test_bytes_are_the_same_every_time_whatever_the_users_settings(kind: str) -> None:
    first = image(chart(), kind)
    with mpl.rc_context({"font.size": 20, "svg.hashsalt": None, "savefig.dpi": 50, "hatch.linewidth": 3}):
        assert image(chart(), kind) == first


def test_an_svg_holds_no_date_and_its_texts_can_be_searched() -> None:
    text = image(picture(), "svg").decode()
    assert "dc:date" not in text
    assert "HRP" in texts(text.encode())


@pytest.mark.parametrize(("name", "start"), [("a.svg", b"<?xml"), ("a.PDF", b"%PDF"), ("a.png", b"\x89PNG")])
def test_the_suffix_names_the_format(tmp_path: Path, name: str, start: bytes) -> None:
    save(picture(), tmp_path / name)
    assert (tmp_path / name).read_bytes().startswith(start)


@pytest.mark.parametrize("name", ["chart.bmp", "chart", "chart.svg.gz"])
def test_another_suffix_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match=r"chart.*\.svg, \.pdf or \.png"):
        save(picture(), tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_path_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none/chart\.svg' cannot be written: give a file in a folder that exists"):
        save(picture(), tmp_path / "none" / "chart.svg")
    (tmp_path / "folder.svg").mkdir()
    with pytest.raises(InputError, match=r"folder\.svg' cannot be written"):
        save(picture(), tmp_path / "folder.svg")
