"""Views of the explorer, each of another design, beside the picture `gantt` draws of one, and its simulation alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from io import BytesIO
from itertools import cycle
from typing import Any

from benchmarks.timing import Result, seconds, times_faster
from reports import gantt, method_panel
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import select
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from studies.explorer.design import Design
from studies.explorer.view import explore

TABLE = load_costs("counted-9-3-3")
COSTS = select(TABLE, "dual-rate")


def results() -> Iterator[Result]:
    of_a_model = _views(80, 44, model="ins-gps", within="0.4", hr_hz=400, processor="cortex-m4f")
    of_steps = _views(1000, 400, costs="counted-9-3-3")
    timing = Timing(1000, 400, 1000)
    speed = least_speed(COSTS, timing).speed
    alone = seconds(lambda: simulate(COSTS, timing, speed, 1, keep_slices=True))
    yield Result(
        "explorer: views in the time of a printed Gantt chart, N = 80", times_faster(of_a_model, _picture, 3), 10
    )
    yield Result("explorer: a view over its simulation alone, N = 1000", seconds(of_steps, 15) / alone, 5, higher=False)


def _views(N: int, M: int, **others: Any) -> Callable[[], object]:
    """Of another L each time, as while it is dragged."""
    landings = cycle(range(M + 1, N + 1))
    design = Design(N=N, M=M, **others)

    def view() -> object:
        return explore(replace(design, L=next(landings))).document()

    view()
    return view


def _picture() -> None:
    timing = Timing(80, 44, 80)
    speed = least_speed(COSTS, timing).speed
    gantt(method_panel(TABLE, "dual-rate", timing, speed)).savefig(BytesIO(), format="svg")
