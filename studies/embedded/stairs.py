"""The dual rate filter as two real-time threads: through two steps of its staircase, and with priorities swapped."""

from __future__ import annotations

import platform
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from filters.systems.example import example_system
from sched_sim.costs.table import PAPERS
from sched_sim.costs.table_file import load_costs
from sched_sim.design.methods import select
from sched_sim.errors import InputError
from studies.board.wanted import Filter
from studies.embedded.sources import FIRST, SIZES
from studies.live.alone import alone_on
from studies.live.design import Design, check_design, of_dual_rate
from studies.live.jobs import Ran
from studies.live.measure import Measured, measured
from studies.live.probe import check_resolved, resolution
from studies.live.program import compiled, steps_of
from studies.live.rights import check_rights, chosen_core
from studies.live.stairs import through_two_steps
from studies.measurement.job_times import Progress, silent
from studies.measurement.methods import machine

SPEED, PERIOD_NS, CYCLES = Fraction(85, 100), 10_000_000, 100
"""Of the run with swapped priorities, between two steps; of each run."""
THOROUGH_CYCLES = 500


class Record(NamedTuple):
    """runs: at ascending speeds. swapped: one at `SPEED` in which LR preempts HR. about: where and when."""

    runs: Sequence[Measured]
    swapped: Measured
    about: dict[str, str]


def design(cycles: int = CYCLES) -> Design:
    """N and M of `FIRST`, and the paper's costs."""
    costs = of_dual_rate(select(load_costs(PAPERS), "dual-rate"))
    return Design(costs, FIRST.N, FIRST.M, SPEED, PERIOD_NS, cycles)


def record(thorough: bool = False, progress: Progress = silent) -> Record:
    """Two minutes; thorough: ten.

    Raises InputError where it cannot run: no Linux, no compiler, no right to real-time priorities.
    """
    check_rights()
    core, middle = chosen_core(None), design(THOROUGH_CYCLES if thorough else CYCLES)
    designs = through_two_steps(middle)
    wanted = Filter(
        "dual-rate", example_system(*SIZES), np.zeros(SIZES[0]), "textbook", "double",
        steps_of(middle.N, middle.M), "",
    )  # fmt: skip
    try:
        with compiled(wanted) as program, alone_on(core):
            found = resolution(program, middle, core)
            for each in designs:
                check_resolved(found, each, check_design(each))
            runs = []
            for done, each in enumerate(designs):
                progress(done, len(designs) + 1, f"live, speed {float(each.speed):.4g}")
                runs.append(measured(program.run(each, core), each, check_design(each)))
            progress(len(designs), len(designs) + 1, "live, priorities swapped")
            wrong = measured(program.run(middle, core, swapped=True), middle, check_design(middle))
    except InputError:
        raise
    except ValueError as error:
        raise InputError(f"live runs are not possible here: {error}") from error
    about = {
        "machine": machine(),
        "kernel": f"{platform.system()} {platform.release()}",
        "date": datetime.now(UTC).date().isoformat(),
        "core": str(core),
    }
    return Record(runs, wrong, about)


def judged(speed: Fraction, cycles: Iterable[tuple[int | None, bool]], differing: int, taken_share: float) -> Measured:
    """What a run at this speed came to, of what was kept: by cycle, where it landed and whether it was disturbed."""
    landed, disturbed = map(list, zip(*cycles, strict=True))
    of = design(len(landed))._replace(speed=speed)
    return Measured(of, check_design(of), Ran((), differing), landed, [], disturbed, [], taken_share)
