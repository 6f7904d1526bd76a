"""What a page is told of a Gantt panel is its schedule."""

from __future__ import annotations

import json
from collections import Counter

from reports.charts.panels import method_panel, zoomed
from reports.charts.told import DECIMALS, told
from sched_sim.costs.table_file import load_costs
from sched_sim.design.timing import Timing
from sched_sim.schedule.intervals import bars, jobs

PANEL = method_panel(load_costs("steffes2014"), "dual-rate", Timing(10, 4, 8), 0.6, cycles=2)


def test_every_job_and_every_bar() -> None:
    schedule, period = told(PANEL)["schedule"], PANEL.schedule.period
    shown = schedule["jobs"]
    assert shown["release"] == [round(job.release / period, DECIMALS) for job in jobs(PANEL.schedule)]
    assert shown["missed"] == [job.missed for job in jobs(PANEL.schedule)]
    assert any(shown["missed"])
    labels = Counter(schedule["styles"][style]["label"] for style in schedule["bars"]["style"])
    assert labels == Counter(bar.style for bar in bars(PANEL.schedule))
    assert [mark["label"] for mark in schedule["marks"]] == [mark.text for mark in PANEL.marks]
    assert "origin" not in schedule


def test_its_words_without_what_the_chart_says_itself() -> None:
    panel = told(PANEL)
    assert panel["title"] == "Dual-rate"
    assert panel["notes"][0] == "speed 0.6"
    assert not any("$" in note or "busy" in note for note in panel["notes"])


def test_how_busy_the_processor_is_to_three_digits_however_little() -> None:
    idle = method_panel(load_costs("steffes2014"), "dual-rate", Timing(10, 4, 8), 2345.6)
    assert told(idle)["schedule"]["busy"] == float(f"{float(idle.schedule.utilization):.3g}") < 0.001


def test_of_a_part_only_its_jobs_are_told() -> None:
    part, whole = (told(panel)["schedule"] for panel in (zoomed(PANEL, 8, 12), PANEL))
    assert (part["origin"], part["steps"]) == (8, 12)
    assert 0 < len(part["jobs"]["row"]) < len(whole["jobs"]["row"])
    assert all(release < 12 for release in part["jobs"]["release"])
    assert len(json.dumps(part)) < len(json.dumps(whole))
