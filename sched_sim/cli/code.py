"""`sched-sim code`: the filter as C for a board."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.measure import SYSTEM, Inputs, Size, UpdateForm
from sched_sim.cli.measure_filter import SIZES
from sched_sim.cli.output import lines, say
from sched_sim.costs.methods import MULTIRATE_METHODS, SYSTEM_METHODS
from sched_sim.errors import InputError

Method = Annotated[
    str,
    typer.Option(
        "--method",
        help=f"{', '.join(SYSTEM_METHODS)}. dual-rate is written as two tasks, others step by step.",
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
        help="HR steps from one measurement to the next; with multirate, from one gain to the next.",
        parser=opt.whole,
        metavar="STEPS",
        rich_help_panel=opt.DESIGN,
    ),
]
Delay = Annotated[
    int,
    typer.Option(
        "-M",
        help="Delay of the measurement in HR steps; more than N with recalculate, larsen, clone and carried-gain.",
        parser=opt.whole,
        metavar="STEPS",
        rich_help_panel=opt.DESIGN,
    ),
]
Landing = Annotated[
    int | None,
    typer.Option(
        "-L",
        help="Step in which the correction lands, M < L <= N, by default M + 1; with dual-rate, or later if it is not "
        "ready, and delayed-horizon. With multirate: step from which a gain is used, by default 0.",
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
    from studies.board.serial.methods import check_model
    from studies.board.steps import Steps
    from studies.board.wanted import Filter
    from studies.board.write import NAMES, board_files, check_wanted
    from studies.measurement.user_function import explained
    from studies.measurement.user_system import load_system

    opt.known_methods([method], SYSTEM_METHODS)
    without = UNUSED.get(method, "L")
    if given := opt.given_options(context, lambda name: name in without):
        raise InputError(f"--method {method}: leave out {', '.join(given)}: {_why_without(method)}")
    if system is not None and (given := opt.given_options(context, lambda name: name in SIZES)):
        raise InputError(f"--system {system!r}: leave out {', '.join(given)}: the system has its own")
    delay = 0 if "M" in without else M
    steps = Steps(N, delay, L if L is not None else delay + (method in LANDING))
    check_folder(output, NAMES, "--output")
    if system is None:
        check_wanted(method, (states, inputs, measurements), steps)
        the_system = f"--states {states} --inputs {inputs} --measurements {measurements}"
        model, x0 = example_system(states, inputs, measurements), np.zeros(states)
    else:
        the_system = f"--system {system}"
        model, x0 = load_system(system)
        check_wanted(method, model[:3], steps)
    alone = False
    try:
        check_model(method, model, steps)
    except InputError:
        if opt.given_options(context, lambda name: name in "NL"):
            raise
        alone = True
    asked = "" if alone else "".join(name for name in "NML" if name not in without)
    in_steps = "".join(f" -{name} {getattr(steps, name)}" for name in asked)
    said = (
        f"sched-sim code --method {method} {the_system} --update {update} --precision {precision}{in_steps} -o FOLDER"
    )
    with explained(f"{the_system}: cannot be written as C"):
        files = board_files(Filter(method, model, x0, update, precision, None if alone else steps, said))
    write_folder(output, files, NAMES, "--output")
    say(
        lines(
            f"Wrote {output}: {', '.join(files)}",
            f"Written for{in_steps}" if in_steps else JOBS_ALONE,
            f"Try it: cc -std=c99 -O2 -ffp-contract=off {' '.join(_tested(files))} -lm -o test && ./test",
        )
    )


def _tested(files: dict[str, str]) -> list[str]:
    return [name for name in ("filter.c", "tasks.c", "steps.c", "test.c") if name in files]


UNUSED = {"standard": "ML", "dual-rate": "", "delayed-horizon": ""} | {str(name): "M" for name in MULTIRATE_METHODS}
"""What of N, M, L methods have no use for; others of L."""
LANDING = ("dual-rate", "delayed-horizon")
"""Those whose correction lands in a step of its own, behind m."""


JOBS_ALONE = (
    "Its jobs alone: a model over N steps is known only of a linear_system whose Phi and Q do not change, or for -N 1"
)


def _why_without(method: str) -> str:
    if method in MULTIRATE_METHODS:
        return "it has a measurement in every step, which is used at once"
    return "it uses a measurement in the step in which it is there"
