"""What the sliders of the report go through is what the analysis says of each state."""

from __future__ import annotations

import re

from reports.steffes.sliding import SPEEDS, frames_over_l, frames_over_speed
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import select
from sched_sim.design.timing import Timing

PAPER = load_costs("steffes2014")
N, M = 10, 4


def test_for_each_l_both_methods_at_their_least_speeds_miss_nothing() -> None:
    frames = frames_over_l(PAPER, N, M)
    for L, (label, panels) in zip(range(M + 1, N + 1), frames, strict=True):
        assert label.startswith(f"L = {L}: speed ")
        for method, panel in zip(("larsen", "dual-rate"), panels, strict=True):
            least = float(least_speed(select(PAPER, method), Timing(N, M, L)).speed)
            assert panel.notes[0] == f"speed {least:.4g}"
            assert panel.schedule.misses == 0
        assert any(f"k+{L}$" in note for note in panels[1].notes), "it lands where it is asked for"


def test_the_faster_the_processor_the_earlier_the_correction_lands_and_the_label_says_where() -> None:
    frames = frames_over_speed(PAPER, N, M)
    assert len(frames) == len(SPEEDS)
    landed = []
    for speed, (label, (panel,)) in zip(SPEEDS, frames, strict=True):
        assert label.startswith(f"speed {float(speed):.2f}: ")
        (at,) = re.findall(r"lands at L = (\d+)|nothing lands", label)
        assert list(panel.schedule.achieved) == [int(at)] if at else panel.schedule.misses > 0
        landed.append(int(at) if at else N + 1)
    assert landed == sorted(landed, reverse=True)
    assert (landed[0], landed[-1]) == (N + 1, M + 1)
