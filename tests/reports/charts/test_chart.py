"""Gantt charts: what they draw, what they say, and that they can be read."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction

import pytest
from matplotlib.collections import PolyCollection

from reports.charts.chart import Panel, gantt, title_lines
from reports.charts.panels import method_panel
from reports.drawing.style import RED
from sched_sim.costs.table_file import load_costs
from sched_sim.design.cycle_marks import cycle_marks
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule.intervals import bars, jobs
from sched_sim.schedule.tasks import Task
from tests.reports.layout import flaws, texts

PAPER, COUNTED = load_costs("steffes2014"), load_costs("counted-9-3-3").normalised()
TASKS = [
    Task("control law", Fraction(1), Fraction("0.1"), 5),
    Task("a task_with $a long name$ that does not end", Fraction(5), Fraction("0.3"), 30, Fraction("0.5")),
]
SAME_STEP = Options(feedback="same-step")


def panel(method: str, N: int, M: int, L: int, speed: str, cycles: int = 1, **more: object) -> Panel:
    return method_panel(PAPER, method, Timing(N, M, L), Fraction(speed), cycles, **more)


def figure_3() -> list[Panel]:
    """Larsen and dual-rate, each at its least speed (Steffes 2014, Fig. 3)."""
    return [panel("larsen", 10, 4, 8, "1.47"), panel("dual-rate", 10, 4, 8, "0.77")]


CASES: dict[str, Callable[[], list[Panel]]] = {
    "figure 3": figure_3,
    "every method": lambda: [
        panel("standard", 10, 4, 8, "1"),
        panel("recalculate", 10, 4, 8, "2.81"),
        *figure_3(),
    ],
    "carried to m": lambda: [
        method_panel(COUNTED, method, Timing(10, M, 10), Fraction(speed), 2)
        for method, M, speed in (("clone", 4, "0.61"), ("clone-split", 10, "0.7"), ("carried-gain", 4, "1"))
    ],
    "100 steps": lambda: [
        panel("larsen", 100, 10, 80, "1.47"),
        panel("dual-rate", 100, 10, 80, "0.66"),
        panel("recalculate", 100, 10, 80, "5.51"),
    ],
    "N = 1": lambda: [panel("dual-rate", 1, 0, 1, "1.7"), panel("larsen", 1, 1, 1, "1.5")],
    "edges": lambda: [
        panel("dual-rate", 10, 0, 1, "1.7"),
        panel("dual-rate", 10, 9, 10, "1.25", 2),
        panel("larsen", 10, 10, 10, "1.47"),
    ],
    "overload": lambda: [
        panel("dual-rate", 10, 4, 8, "0.64"),
        panel("larsen", 10, 4, 8, "1.2"),
        panel("dual-rate", 10, 4, 8, "0.5"),
        panel("dual-rate", 10, 4, 8, "0.645", 6),
    ],
    "2 CPUs": lambda: [
        panel("dual-rate", 10, 4, 8, "0.66", options=Options(cpus=2)),
        panel("larsen", 10, 4, 8, "1.47", options=Options(cpus=2)),
    ],
    "same step": lambda: [
        panel("dual-rate", 10, 4, 8, "0.78", options=SAME_STEP),
        panel("dual-rate", 10, 4, 4, "1.7", options=SAME_STEP),
    ],
    "context switch": lambda: [panel("dual-rate", 10, 4, 8, "0.9", options=Options(context_switch=Fraction("0.02")))],
    "tasks": lambda: [panel("dual-rate", 10, 4, 8, "1.1", 2, tasks=TASKS)],
    "3 cycles": lambda: [panel("dual-rate", 10, 4, 8, "0.78", 3), panel("larsen", 10, 4, 8, "1.47", 3)],
    "30 cycles": lambda: [panel("dual-rate", 10, 4, 8, "0.78", 30)],
    "several in flight": lambda: [
        *(
            method_panel(COUNTED, name, Timing(6, 14, 18), speed, 3)
            for name, speed in (("larsen", 9000), ("clone", 6000), ("dual-rate", 5500))
        ),
        panel("dual-rate", 10, 4, 14, "0.66", 3),
    ],
}


NARROW = ("figure 3", "edges", "tasks", "several in flight")
"""Drawn in a narrow column in each run of the tests; all in `make exhaust`."""


@pytest.mark.parametrize("case", CASES)
def test_texts_neither_overlap_nor_leave_the_page_and_none_is_small(case: str) -> None:
    assert flaws(gantt(CASES[case]())) == []


@pytest.mark.parametrize("width_mm", [50, *(pytest.param(mm, marks=pytest.mark.exhaust) for mm in (88, 180))])
@pytest.mark.parametrize(
    "case", [*NARROW, *(pytest.param(case, marks=pytest.mark.exhaust) for case in CASES if case not in NARROW)]
)
def test_nor_do_they_in_a_column_of_another_width_with_a_second_axis(case: str, width_mm: float) -> None:
    assert flaws(gantt(CASES[case](), width_mm=width_mm, hr_hz=400)) == []


@pytest.mark.parametrize("case", ["figure 3", "carried to m", "overload", "2 CPUs", "context switch", "tasks"])
def test_what_is_drawn_is_what_ran(case: str) -> None:
    panels = CASES[case]()
    for axes, shown in zip(gantt(panels).axes, panels, strict=False):
        drawn = set()
        for collection in axes.collections:
            if isinstance(collection, PolyCollection):
                assert set(collection.get_linewidth()) <= {0}, "an edge would paint a gap as busy"
                for path in collection.get_paths():
                    across = path.vertices[:, 0]
                    drawn.add((round(across.min(), 9), round(across.max(), 9)))
        period = shown.schedule.period
        assert {(round(bar.start / period, 9), round(bar.end / period, 9)) for bar in bars(shown.schedule)} <= drawn


def test_each_missed_deadline_has_a_red_cross_and_the_title_counts_them() -> None:
    panels = CASES["overload"]()
    for axes, shown in zip(gantt(panels).axes, panels, strict=False):
        crosses = [line for line in axes.lines if line.get_marker() == "x" and line.get_color() == RED]
        found = sorted(step for line in crosses for step in line.get_xdata())
        period, end = shown.schedule.period, shown.end
        missed = sorted(job.deadline / period for job in jobs(shown.schedule) if job.missed)
        assert found == [step for step in missed if step <= end]
        (said,) = [text.get_text() for text in axes.texts if "deadline" in text.get_text()]
        assert said.startswith(f"✗ {shown.schedule.misses} of ")


def test_a_job_that_never_ran_has_its_release_and_its_missed_deadline() -> None:
    """At speed 0.5 the HR jobs, 0.63 each, leave LR propagate the rest of step 1 only: the LR update waits from m = 4
    on and is due at l = 8, and so does the HR job of step 9."""
    axes = gantt([panel("dual-rate", 10, 4, 8, "0.5")]).axes[0]
    found = [(line.get_marker(), line.get_color() == RED, [*map(float, line.get_xdata())]) for line in axes.lines]
    hr_releases, lr_releases = (steps for marker, red, steps in found if (marker, red) == ("^", False))
    hr_crosses, lr_crosses = (steps for marker, red, steps in found if (marker, red) == ("x", True))
    assert (hr_releases, lr_releases) == ([*range(10)], [1.26, 4])
    assert (hr_crosses, lr_crosses) == ([1, *range(3, 11)], [4, 8])
    (said,) = [text.get_text() for text in axes.texts if "deadline" in text.get_text()]
    assert said == "✗ 11 of 12 jobs miss their deadline, 2 never got the processor"


def test_no_miss_no_red() -> None:
    figure = gantt(figure_3())
    assert not [text for text, _ in texts(figure) if text.get_color() == RED]
    said = [text.get_text() for text, _ in texts(figure)]
    assert said.count("no deadline missed") == 2
    assert "work after its deadline" not in said


def test_figure_3_says_what_the_paper_says() -> None:
    said = [text.get_text() for text, _ in texts(gantt(figure_3()))]
    for expected in (
        *("$k$", "$m = l$", "$k+N$", "$m$", "$l$"),
        *("HRP", "HRU", "LRP", "LRU", "P", "U"),
        *("speed 1.47", "speed 0.77", "lands at $l = m = k+4$", "lands at $l = k+8$"),
    ):
        assert expected in said


def test_labels_inside_bars_are_dropped_when_there_is_no_room() -> None:
    labels = [text.get_text() for text, _ in texts(gantt(CASES["30 cycles"]()))]
    assert not {"HRP", "HRU", "LRP", "LRU"} & set(labels)
    assert "HRP  high-rate propagate" in labels


@pytest.mark.parametrize(
    ("timing", "cycles", "landings", "expected"),
    [
        (Timing(10, 4, 8), 1, {0: 8}, {0: "k", 4: "m", 8: "l", 10: "k+N"}),
        (Timing(10, 4, 4), 1, {0: 4}, {0: "k", 4: "m = l", 10: "k+N"}),
        (Timing(10, 4, 8), 1, {}, {0: "k", 4: "m", 10: "k+N"}),
        (Timing(5, 0, 5), 1, {0: 5}, {0: "k = m", 5: "l = k+N"}),
        (Timing(5, 5, 5), 1, {0: 5}, {0: "k", 5: "m = l = k+N"}),
        (Timing(4, 1, 3), 2, {0: 2, 1: 2}, {0: "k", 1: "m", 2: "l", 4: "k+N", 5: "m+N", 6: "l+N", 8: "k+2N"}),
        (Timing(4, 1, 3), 2, {0: 3, 1: 2}, {0: "k", 1: "m", 3: "l", 4: "k+N", 5: "m+N", 6: "l = k+N+2", 8: "k+2N"}),
    ],
)
def test_steps_are_named_as_in_the_paper(
    timing: Timing, cycles: int, landings: dict[int, int], expected: dict[int, str]
) -> None:
    assert {mark.step: mark.text for mark in cycle_marks(timing, cycles, landings)} == expected


def test_marks_of_several_in_flight_go_on_until_the_last_has_landed() -> None:
    """N = 6, M = 14: one that is taken in step 6 lands in 20, in the fourth cycle."""
    flight = method_panel(COUNTED, "larsen", Timing(6, 14, 14), 10_000, cycles=2)
    assert flight.end == 21
    assert {mark.step: mark.text for mark in flight.marks} == {
        0: "k", 6: "k+N", 12: "k+2N", 14: "m = l", 18: "k+3N", 20: "m+N = l+N"
    }  # fmt: skip
    labels = {bar.step: bar.style for bar in bars(flight.schedule) if bar.style in "GU"}
    assert labels == {0: "G", 6: "G", 12: "G", 14: "U", 18: "G", 20: "U"}
    assert flight.notes[1] == "lands at $l = m = k+14$"


def test_too_many_steps_are_refused() -> None:
    with pytest.raises(InputError, match=r"1000000 cycles .* give fewer cycles"):
        panel("larsen", 10, 4, 8, "1.47", 1_000_000)


@pytest.mark.parametrize(("steps", "every"), [(40, 1), (42, 2), (100, 5), (300, 10)])
def test_above_40_steps_arrows_thin_out_and_the_legend_says_so(steps: int, every: int) -> None:
    figure = gantt(panel("larsen", steps, 4, 8, "1.5"))
    for marker, first in ("^", 0), ("v", 1):
        (found,) = [[*map(float, line.get_xdata())] for line in figure.axes[0].lines if line.get_marker() == marker][:1]
        assert found == [*range(first, steps + first, every)]
    said = {text.get_text() for text, _ in texts(figure)}
    assert ("release" if every == 1 else f"release (1 in {every} where crowded)") in said


def test_arrows_of_missed_deadlines_never_thin_out() -> None:
    shown = panel("larsen", 100, 10, 80, "0.46")
    crosses = [line for line in gantt(shown).axes[0].lines if line.get_marker() == "x"]
    assert sum(len(line.get_xdata()) for line in crosses) == shown.schedule.misses > 41


def test_a_stretch_shows_its_steps_and_nothing_beyond() -> None:
    shown = panel("dual-rate", 10, 4, 8, "0.77", 3, first=12, last=19)
    figure = gantt(shown, hr_hz=400)
    axes = figure.axes[0]
    assert axes.get_xlim() == (12, 19)
    for collection in axes.collections:
        if isinstance(collection, PolyCollection):
            for path in collection.get_paths():
                across = path.vertices[:, 0]
                assert across.min() <= 19
                assert across.max() >= 12
    said = {text.get_text() for text, _ in texts(figure)}
    assert {"steps 12 to 18 of 30", "$m+N$", "$l+N$", "LRU  low-rate update"} <= said
    assert not {"LRP  low-rate propagate", "$k+N$", "$k+2N$"} & said
    assert flaws(figure) == []


def test_the_second_axis_is_the_first_in_ms() -> None:
    without, figure = (gantt(figure_3(), hr_hz=rate) for rate in (None, 400))
    ms = next(axes for axes in figure.axes if axes.get_xlabel().startswith("time (ms)"))
    assert ms.get_xlim() == (0, 25)
    assert ms.get_xlabel() == "time (ms), HR loop at 400 Hz"
    steps = figure.axes[1]
    assert (ms.get_position().x0, ms.get_position().x1) == (steps.get_position().x0, steps.get_position().x1)
    assert not [axes for axes in without.axes if "ms" in axes.get_xlabel()]


def test_a_title_too_long_for_a_line_goes_on_in_the_next() -> None:
    lines = title_lines(panel("dual-rate", 10, 4, 8, "0.5"), 50)
    assert [[text for text, _ in line] for line in lines] == [
        ["Dual-rate", "speed 0.5"],
        ["no correction lands", "100 % busy"],
        ["✗ 11 of 12 jobs miss their"],
        ["deadline, 2 never got the"],
        ["processor"],
    ]


def test_drawing_does_not_import_pyplot() -> None:
    modules = "reports.charts.chart, reports.steffes.timelines, reports.steffes.figures"
    code = f"import sys, {modules}; print('matplotlib.pyplot' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "False"
