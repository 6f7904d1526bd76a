"""`sched-sim code`: the filter as C for a board."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple, TypeAlias, cast

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.measure import SYSTEM, ConfirmProbed, Inputs, Size, Sparse, UpdateForm
from sched_sim.cli.measure_filter import OF_A_SYSTEM, SIZES
from sched_sim.cli.output import lines, say
from sched_sim.costs.methods import MULTIRATE_METHODS, ROBUST_METHODS, SYSTEM_METHODS
from sched_sim.errors import InputError
from studies.board.steps import Steps

if TYPE_CHECKING:
    from filters.arrays import FloatArray
    from filters.delayed.dual_rate import GainTime
    from filters.system import System
    from filters.translation.library import Precision
    from studies.board.wanted import Filter

Method = Annotated[
    str,
    typer.Option(
        "--method",
        help=f"{', '.join(SYSTEM_METHODS)}. dual-rate is written as two tasks, others step by step.",
        rich_help_panel=opt.DESIGN,
    ),
]
RobustName: TypeAlias = Literal["attitude", "position"]
OwnFilter = Annotated[
    str | None,
    typer.Option(
        "--filter",
        help="Your own composed filter, of several sensors: package.module:function that returns a ModularFilter, or "
        "with it a typical state, covariance and input.",
        rich_help_panel=SYSTEM,
    ),
]
OwnRobust = Annotated[
    RobustName | None,
    typer.Option(
        "--robust",
        help="The extended robust filter of a vehicle's attitude or position instead, with --method robust-closed "
        "(default) or another of measure --robust.",
        rich_help_panel=SYSTEM,
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
        help="Delay of the measurement in HR steps; more than N with dual-rate, recalculate, larsen, clone and "
        "carried-gain.",
        parser=opt.whole,
        metavar="STEPS",
        rich_help_panel=opt.DESIGN,
    ),
]
Landing = Annotated[
    int | None,
    typer.Option(
        "-L",
        help="Step in which the correction lands, by default M + 1; with dual-rate, or later if it is not ready, and "
        "with delayed-horizon, L <= N. With multirate: step from which a gain is used, by default 0.",
        parser=opt.whole,
        metavar="STEPS",
        rich_help_panel=opt.DESIGN,
    ),
]
Gain = Annotated[
    Literal["at-update", "precomputed"],
    typer.Option(
        "--gain",
        help="With dual-rate: compute H, R, K in the LR update, or before it (III.D).",
        rich_help_panel=opt.DESIGN,
    ),
]
Noise = Annotated[
    Literal["exact", "sum", "euler"],
    typer.Option(
        "--low-rate-noise",
        help="With dual-rate: Q over N steps by Eq. 18 or 23; that by Eq. 24 is not written.",
        rich_help_panel=opt.DESIGN,
    ),
]
InPrecision = Annotated[
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
    own_filter: OwnFilter = None,
    robust: OwnRobust = None,
    method: Method = "dual-rate",
    update: UpdateForm = "textbook",
    sparse: Sparse = False,
    confirm_probed: ConfirmProbed = False,
    precision: InPrecision = "double",
    N: Cycle = 10,
    M: Delay = 4,
    L: Landing = None,
    gain: Gain = "at-update",
    low_rate_noise: Noise = "exact",
) -> None:
    """Write a filter as C99, translated from the same Python as was counted and timed, with a program that compares it
    with Python, examples for FreeRTOS and POSIX, and a README.

    sched-sim code --method dual-rate --states 9 --inputs 3 --measurements 3 --precision single -N 10 -M 4 -o board/
    sched-sim code --system mymodule:my_system --update short --sparse -o board/
    sched-sim code --method larsen -o larsen/
    sched-sim code --filter mymodule:my_filter -o board/
    sched-sim code --robust attitude --method robust-givens -N 40 -o board/
    """
    from studies.board.dual_rate import check_choices
    from studies.board.folder import check_folder, write_folder
    from studies.board.wanted import Filter
    from studies.board.write import NAMES
    from studies.measurement.sparsity import refuse_dense, with_structure

    if confirm_probed and not sparse:
        raise InputError("--confirm-probed: only with --sparse, which leaves out what probing finds")
    if method != "dual-rate" or own_filter is not None or robust is not None:
        _refuse_beside(context, _asked_for(method, own_filter, robust), CHOICES, "only --method dual-rate has it")
    check_choices(low_rate_noise)
    if own_filter is not None:
        _refuse_beside(context, f"--filter {own_filter}", (*OF_A_SYSTEM, "robust", "N", "M", "L"), OF_A_FILTER)
    if robust is not None:
        _refuse_beside(
            context, f"--robust {robust}", (*SIZES, "system", "update", *ZEROS, "M", "L"), OF_A_ROBUST_FILTER
        )
    check_folder(output, NAMES, "--output")
    if own_filter is not None:
        written = _own_filter(own_filter, precision)
    elif robust is not None:
        chosen = method if opt.given_options(context, lambda name: name == "method") else "robust-closed"
        written = _robust(robust, chosen, precision, N)
    else:
        opt.known_methods([method], SYSTEM_METHODS)
        without = UNUSED.get(method, "L")
        if given := opt.given_options(context, lambda name: name in without):
            raise InputError(f"--method {method}: leave out {', '.join(given)}: {_why_without(method)}")
        if system is not None:
            _refuse_beside(context, f"--system {system!r}", SIZES, "the system has its own")
        delay = 0 if "M" in without else M
        steps = Steps(N, delay, L if L is not None else delay + (method in LANDING))
        model, x0, the_system = _model(method, (states, inputs, measurements), system, steps, gain)
        if sparse:
            refuse_dense(method)
            model = with_structure(model, x0, the_system, confirmed=confirm_probed)
        else:
            model = model._replace(structure=None)
        asked = bool(opt.given_options(context, lambda name: name in "NL"))
        wanted = Filter(method, model, x0, update, precision, steps, "", gain, low_rate_noise)
        written = _of_a_system(wanted, the_system, confirm_probed, asked)
    write_folder(output, written.files, NAMES, "--output")
    say(
        lines(
            f"Wrote {output}: {', '.join(written.files)}",
            written.note,
            f"Try it: cc -std=c99 -O2 -ffp-contract=off {' '.join(_tested(written.files))} -lm -o test && ./test",
        )
    )


class Written(NamedTuple):
    """Files by name, and what is said of them."""

    files: dict[str, str]
    note: str


def _model(
    method: str, sizes: tuple[int, int, int], system: str | None, steps: Steps, gain: GainTime
) -> tuple[System, FloatArray, str]:
    """A model, a typical state, and the options that name it."""
    import numpy as np

    from filters.systems.example import example_system
    from studies.board.write import check_wanted
    from studies.measurement.user_system import load_system

    if system is None:
        check_wanted(method, sizes, steps, gain)
        return example_system(*sizes), np.zeros(sizes[0]), "--states {} --inputs {} --measurements {}".format(*sizes)
    model, x0 = load_system(system)
    check_wanted(method, model[:3], steps, gain)
    return model, x0, f"--system {system}"


def _of_a_system(wanted: Filter, the_system: str, probed: bool, asked: bool) -> Written:
    """probed: whether what probing finds was confirmed. asked: whether the steps were given, so that the jobs alone
    would not do."""
    from studies.board.serial.methods import check_model
    from studies.board.write import board_files
    from studies.measurement.user_function import explained

    method, system, steps = wanted.method, wanted.system, wanted.steps
    assert steps is not None
    try:
        check_model(method, system, steps)
        used = "".join(name for name in "NML" if name not in UNUSED.get(method, "L"))
    except InputError:
        if asked:
            raise
        wanted, used = wanted._replace(steps=None), ""
    in_steps = "".join(f" -{name} {getattr(steps, name)}" for name in used)
    zeros = f"{' --sparse' if system.structure else ''}{' --confirm-probed' if probed else ''}"
    chosen = "".join(f" --{name.replace('_', '-')} {value}" for name, value in wanted.choices.items())
    said = (
        f"sched-sim code --method {method} {the_system} --update {wanted.update}{zeros} --precision {wanted.precision}"
        f"{in_steps}{chosen} -o FOLDER"
    )
    with explained(f"{the_system}: cannot be written as C"):
        files = board_files(wanted._replace(said=said))
    return Written(files, f"Written for{in_steps}" if in_steps else JOBS_ALONE)


def _robust(name: RobustName, method: str, precision: Precision, N: int) -> Written:
    from studies.board.robust import Robust, robust_files
    from studies.board.write import check_cycle
    from studies.measurement.user_function import explained
    from studies.robust.costs import robust_case

    opt.known_methods([method], ROBUST_METHODS)
    check_cycle(N)
    said = f"sched-sim code --robust {name} --method {method} --precision {precision} -N {N} -o FOLDER"
    way = cast(Any, method.removeprefix("robust-"))
    with explained(f"--robust {name}: cannot be written as C"):
        files = robust_files(Robust(name, robust_case(name), way, precision, N, said))
    return Written(files, f"Written for -N {N}")


def _own_filter(name: str, precision: Precision) -> Written:
    from studies.board.composed.files import composed_files
    from studies.board.composed.wanted import Composed
    from studies.measurement.user_filter import load_start
    from studies.measurement.user_function import explained

    said = f"sched-sim code --filter {name} --precision {precision} -o FOLDER"
    start = load_start(name)
    with explained(f"--filter {name}: cannot be written as C"):
        files = composed_files(Composed(name, *start, precision, said))
    return Written(files, "Late measurements are used where they were taken, and the steps since done again")


CHOICES = ("gain", "low_rate_noise")
ZEROS = ("sparse", "confirm_probed")
OF_A_FILTER = "the filter that it returns says all of that itself"
OF_A_ROBUST_FILTER = "it has a system of its own"


def _asked_for(method: str, own_filter: str | None, robust: str | None) -> str:
    if own_filter is not None:
        return f"--filter {own_filter}"
    return f"--robust {robust}" if robust is not None else f"--method {method}"


def _refuse_beside(context: typer.Context, given: str, names: Collection[str], why: str) -> None:
    """Raises InputError for options that were given and have no meaning beside what is given."""
    if others := opt.given_options(context, lambda name: name in names):
        raise InputError(f"{given}: leave out {', '.join(others)}: {why}")


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
