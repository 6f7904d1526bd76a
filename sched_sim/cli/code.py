"""`sched-sim code`: the filter as C for a board."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.measure import SYSTEM, Inputs, Size, UpdateForm
from sched_sim.cli.measure_filter import SIZES
from sched_sim.cli.output import lines, say
from sched_sim.costs.methods import SYSTEM_METHODS
from sched_sim.errors import InputError

Method = Annotated[
    str,
    typer.Option(
        "--method",
        help=f"{', '.join(SYSTEM_METHODS)}. dual-rate is written as two tasks, standard, "
        "recalculate and larsen step by step, others as jobs.",
        rich_help_panel=opt.DESIGN,
    ),
]
OwnSystem = Annotated[
    str | None,
    typer.Option(
        "--system",
        help="Your own: package.module:function that returns a System, or a System and a typical state.",
        rich_help_panel=SYSTEM,
    ),
]
Cycle = Annotated[
    int,
    typer.Option(
        "-N",
        help="HR steps from one measurement to the next; with dual-rate, standard, recalculate, larsen.",
        parser=opt.whole,
        metavar="STEPS",
        rich_help_panel=opt.DESIGN,
    ),
]
Delay = Annotated[
    int,
    typer.Option(
        "-M",
        help="Delay of the measurement in HR steps, less than N; with dual-rate, recalculate, larsen.",
        parser=opt.whole,
        metavar="STEPS",
        rich_help_panel=opt.DESIGN,
    ),
]
Landing = Annotated[
    int | None,
    typer.Option(
        "-L",
        help="With dual-rate: step in which the correction lands, M < L <= N, however early it is ready; by default "
        "M + 1, as soon as it is ready.",
        parser=opt.whole,
        metavar="STEPS",
        rich_help_panel=opt.DESIGN,
    ),
]
Precision = Annotated[
    Literal["single", "double"], typer.Option("--precision", help="Of the numbers: single (float) or double.")
]
Folder = Annotated[
    Path,
    typer.Option(
        "--output",
        "-o",
        help="Folder to write: a new one, or one that this command has written.",
        rich_help_panel=opt.OUTPUT,
    ),
]


def code(
    context: typer.Context,
    output: Folder,
    states: Size = 9,
    inputs: Inputs = 3,
    measurements: Size = 3,
    system: OwnSystem = None,
    method: Method = "dual-rate",
    update: UpdateForm = "textbook",
    precision: Precision = "double",
    N: Cycle = 10,
    M: Delay = 4,
    L: Landing = None,
) -> None:
    """Write a filter as C99, translated from the same Python as was counted and timed, with a program that compares it
    with Python, examples for FreeRTOS and POSIX, and a README.

    sched-sim code --method dual-rate --states 9 --inputs 3 --measurements 3 --precision single -N 10 -M 4 -o board/
    sched-sim code --system mymodule:my_system --update short -o board/
    sched-sim code --method larsen -o larsen/
    """
    import numpy as np

    from filters.systems.example import example_system
    from studies.board.folder import check_folder, write_folder
    from studies.board.steps import Steps
    from studies.board.wanted import Filter
    from studies.board.write import NAMES, board_files, check_wanted
    from studies.measurement.user_function import explained
    from studies.measurement.user_system import load_system

    opt.known_methods([method], SYSTEM_METHODS)
    without = STEPS.get(method, "NML")
    if given := opt.given_options(context, lambda name: name in without):
        raise InputError(f"--method {method}: leave out {', '.join(given)}: {_why_without(method)}")
    if system is not None and (given := opt.given_options(context, lambda name: name in SIZES)):
        raise InputError(f"--system {system!r}: leave out {', '.join(given)}: the system has its own")
    steps = None
    if method in STEPS:
        delay = 0 if method == "standard" else M
        steps = Steps(N, delay, L if L is not None else delay + (method == "dual-rate"))
    check_folder(output, NAMES, "--output")
    if system is None:
        check_wanted(method, (states, inputs, measurements), steps)
        the_system = f"--states {states} --inputs {inputs} --measurements {measurements}"
        model, x0 = example_system(states, inputs, measurements), np.zeros(states)
    else:
        the_system = f"--system {system}"
        model, x0 = load_system(system)
        check_wanted(method, model[:3], steps)
    in_steps = "" if steps is None else "".join(f" -{name} {getattr(steps, name)}" for name in _asked(method))
    said = (
        f"sched-sim code --method {method} {the_system} --update {update} --precision {precision}{in_steps} -o FOLDER"
    )
    with explained(f"{the_system}: cannot be written as C"):
        files = board_files(Filter(method, model, x0, update, precision, steps, said))
    write_folder(output, files, NAMES, "--output")
    say(
        lines(
            f"Wrote {output}: {', '.join(files)}",
            in_steps and f"Written for{in_steps}",
            f"Try it: cc -std=c99 -O2 -ffp-contract=off {' '.join(_tested(files))} -lm -o test && ./test",
        )
    )


def _tested(files: dict[str, str]) -> list[str]:
    return [name for name in ("filter.c", "tasks.c", "steps.c", "test.c") if name in files]


STEPS = {"dual-rate": "", "standard": "ML", "recalculate": "L", "larsen": "L"}
"""Methods that are written with what is around the jobs, and what of N, M, L they have no use for."""


def _asked(method: str) -> str:
    """What of N, M, L it is written for."""
    return "".join(name for name in "NML" if name not in STEPS[method])


def _why_without(method: str) -> str:
    if method not in STEPS:
        return f"its jobs are written, without the steps around them; {', '.join(STEPS)} are written as a whole"
    return "it uses a measurement in the step in which it is there"
