"""`sched-sim measure`: what each job really costs here."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from sched_sim.bounds import MOST_STATES
from sched_sim.cli import options as opt
from sched_sim.cli.measure_filter import (
    OF_A_SYSTEM,
    OF_TIMES,
    SIZES,
    Cold,
    InSequence,
    measure_own_filter,
    refuse_with_filter,
)
from sched_sim.cli.output import lines, print_csv, print_json, print_table, say
from sched_sim.cli.outputs import module_files, refuse_one_file_for_two
from sched_sim.costs.methods import SYSTEM_METHODS
from sched_sim.costs.table import units
from sched_sim.errors import InputError

if TYPE_CHECKING:
    from sched_sim.costs.table import Cost, CostTable

SYSTEM = "System"
BOARD = "Board"
BackendName = Literal["compiled", "counted", "numpy", "c", "emulated"]
OF_A_BOARD = ("target", "precision")
"""Options of `measure` that say which core is emulated, and how."""
WITHOUT_SYSTEM = "Not with --system, --filter or --robust, which have their own."
WITHOUT_FILTER = "Not with --filter or --robust."


def _size(text: str) -> int:
    number = opt.at_least_one(text)
    if number > MOST_STATES:
        raise typer.BadParameter(f"{number} is too large: give at most {MOST_STATES}.")
    return number


Backend = Annotated[
    BackendName,
    typer.Option(
        "--backend",
        help="compiled: time of code compiled by numba; counted: exact operation counts, of a model written with "
        "+ - * /, functions of single numbers (np.sin, math.sin) and products of arrays; numpy: time of NumPy calls; "
        "c: time of C that this machine's compiler makes of the same source; "
        "emulated: instructions, not cycles, of C on a board's core, with --target.",
    ),
]
OnTarget = Annotated[
    str | None,
    typer.Option(
        "--target",
        help="With --backend emulated: cortex-m4f (single precision), cortex-m7 (double), cortex-m4-soft (double, in "
        "software) or cortex-m33 (single). Needs QEMU and the cross compiler.",
        rich_help_panel=BOARD,
    ),
]
InPrecision = Annotated[
    str | None,
    typer.Option(
        "--precision",
        help="With --backend emulated: single or double; by default that of the target.",
        rich_help_panel=BOARD,
    ),
]
UpdateForm = Annotated[
    Literal["textbook", "joseph", "short"],
    typer.Option(
        "--update",
        help="Covariance update: textbook (Eq. 11, that of the shipped counts), joseph (a covariance for any gain) or "
        f"short, P - K (P H')' (the cheapest: with few measurements a small part of the textbook's). {WITHOUT_FILTER}",
    ),
]
Sparse = Annotated[
    bool,
    typer.Option(
        "--sparse",
        help="Leave out what is always zero or one in F, H, Q and R, as the model states it (System.structure), and "
        f"compute of what is symmetric one half; beside it, the dense filter's. {WITHOUT_FILTER}",
        rich_help_panel=SYSTEM,
    ),
]
ConfirmProbed = Annotated[
    bool,
    typer.Option(
        "--confirm-probed",
        help="With --sparse: the model states nothing, and what is zero or one at many random states is so at all.",
        rich_help_panel=SYSTEM,
    ),
]
Size = Annotated[
    int,
    typer.Option(
        help=f"Size of the example system. {WITHOUT_SYSTEM}", parser=_size, metavar="COUNT", rich_help_panel=SYSTEM
    ),
]
Inputs = Annotated[
    int,
    typer.Option(
        help=f"Size of the example system; 0: it has none. {WITHOUT_SYSTEM}",
        parser=opt.none_or_more,
        metavar="COUNT",
        rich_help_panel=SYSTEM,
    ),
]
Wanted = Annotated[
    list[str] | None,
    typer.Option(
        "--method",
        help=f"{', '.join(SYSTEM_METHODS)}; repeatable; by default all. standard is the unit and always among them. "
        f"{WITHOUT_FILTER}",
        rich_help_panel=opt.DESIGN,
    ),
]
OwnSystem = Annotated[
    str | None,
    typer.Option(
        "--system",
        help="Your own: package.module:function that returns a System, or a System and a typical state. "
        f"{WITHOUT_FILTER}",
        rich_help_panel=SYSTEM,
    ),
]
CostFile = Annotated[
    Path | None,
    typer.Option("--output", "-o", help="Cost table to write, for --costs.", rich_help_panel=opt.OUTPUT),
]


OwnFilter = Annotated[
    str | None,
    typer.Option(
        "--filter",
        help="Your own composed filter: package.module:function that returns a ModularFilter, or with it a typical "
        "state, covariance and input. The time of each of 100,000 executions of each part is written, for a scenario "
        "to draw from.",
        rich_help_panel=SYSTEM,
    ),
]
Robust = Annotated[
    Literal["attitude", "position"] | None,
    typer.Option(
        "--robust",
        help="Measure the methods robust-... instead: the extended robust filter of a vehicle's attitude or position.",
        rich_help_panel=SYSTEM,
    ),
]
Parallel = Annotated[
    int | None,
    typer.Option(
        "--parallel",
        help="With --robust: count Givens rotations on a device that does so many column pairs at a time.",
        parser=opt.at_least_one,
        metavar="COUNT",
        rich_help_panel=SYSTEM,
    ),
]


def measure(
    context: typer.Context,
    states: Size = 9,
    inputs: Inputs = 3,
    measurements: Size = 3,
    system: OwnSystem = None,
    own_filter: OwnFilter = None,
    robust: Robust = None,
    parallel: Parallel = None,
    method: Wanted = None,
    backend: Backend = "compiled",
    target: OnTarget = None,
    precision: InPrecision = None,
    update: UpdateForm = "textbook",
    sparse: Sparse = False,
    confirm_probed: ConfirmProbed = False,
    cold: Cold = False,
    sequence: InSequence = False,
    thorough: Annotated[
        bool, typer.Option("--thorough", help="Ten times as many rounds; with --filter, executions.")
    ] = False,
    output: CostFile = None,
    format: opt.Format = "table",
) -> None:
    """Measure what each job of each filter costs, on the real code, and write it as a cost table.

    sched-sim measure --states 15 --inputs 6 --measurements 3 -o costs.toml
    sched-sim measure --system mymodule:my_system -o costs.toml
    sched-sim measure --robust position --backend counted -o erkf.toml
    sched-sim measure --filter mymodule:my_filter --sequence -o samples.toml
    sched-sim measure --backend emulated --target cortex-m4f -o m4f.toml
    sched-sim measure --system mymodule:my_system --backend counted --sparse -o sparse.toml
    """
    import numpy as np

    from filters.registry import SPARSE_METHODS
    from filters.systems.example import example_system
    from sched_sim.cli.instructions import built_note, target_note, target_row
    from sched_sim.cli.measured_note import busy_row, say_busy
    from sched_sim.cli.own_note import own_note, own_share
    from sched_sim.cli.progress import progress_bar
    from sched_sim.cli.update_form import update_form
    from sched_sim.costs.table import busy_note
    from sched_sim.costs.table_file import write_costs
    from sched_sim.files.writable import check_writable
    from studies.measurement.emulation.targets import precision_of, target_of
    from studies.measurement.emulation.toolchain import check_installed
    from studies.measurement.methods import measure as run
    from studies.measurement.sparsity import in_words, refuse_dense, with_structure
    from studies.measurement.user_function import explained
    from studies.measurement.user_system import load_system

    if output is not None:
        check_writable(output, "--output")
    if backend != "emulated" and (options := opt.given_options(context, lambda name: name in OF_A_BOARD)):
        raise InputError(f"{', '.join(options)}: only with --backend emulated, which --backend {backend} is not")
    if backend == "emulated" and (options := opt.given_options(context, lambda name: name == "thorough")):
        raise InputError("--thorough: leave it out: instructions on an emulated core are the same in each run")
    if backend == "emulated":
        precision = precision_of(target_of(target), precision)
        check_installed()
    if own_filter is not None:
        refuse_with_filter(own_filter, context)
        measure_own_filter(own_filter, backend, thorough, cold, sequence, output, format)
        return
    if options := opt.given_options(context, lambda name: name in OF_TIMES):
        raise InputError(f"{', '.join(options)}: only with --filter, whose executions are timed one by one")
    if robust is None and parallel is not None:
        raise InputError(f"--parallel {parallel} is for the robust filter: give --robust attitude or position too")
    if robust is not None and (options := opt.given_options(context, lambda name: name in OF_A_SYSTEM)):
        raise InputError(
            f"--robust {robust} measures the methods robust-... on a system of its own: leave out {', '.join(options)}"
        )
    if confirm_probed and not sparse:
        raise InputError("--confirm-probed: only with --sparse, which leaves out what probing finds")
    if sparse and backend == "numpy":
        raise InputError("--sparse: not with --backend numpy, which multiplies whole matrices")
    known, dense, structure = SPARSE_METHODS if sparse else SYSTEM_METHODS, None, None
    if sparse:
        refuse_dense(*(name for name in method or () if name in SYSTEM_METHODS))
    if system is not None and (options := opt.given_options(context, lambda name: name in SIZES)):
        raise InputError(f"--system {system!r}: leave out {', '.join(options)}: the system has its own")
    with progress_bar("Measuring") as progress:
        if robust is not None:
            table = _robust(robust, parallel, backend, thorough, progress, target, precision)
        else:
            methods = opt.known_methods(["standard", *(method or known)], SYSTEM_METHODS)
            if system is None:
                model, x0 = example_system(states, inputs, measurements), None
                name = f"{target if backend == 'emulated' else backend}-{states}-{inputs}-{measurements}"
                the_system = f"--states {states} --inputs {inputs} --measurements {measurements}"
            else:
                model, x0 = load_system(system)
                refuse_one_file_for_two([("--output", output)], [("--system", file) for file in module_files()])
                name = f"{target if backend == 'emulated' else backend}-{system.replace(':', '.')}"
                the_system = f"--system {system!r}"
            if sparse:
                state = np.zeros(model.states) if x0 is None else x0
                model = with_structure(model, state, the_system, confirmed=confirm_probed)
                structure = model.structure

            def measured(*, without_zeros: bool) -> CostTable:
                return run(
                    model,
                    backend,
                    update,
                    name=f"{name}-sparse" if without_zeros else name,
                    thorough=thorough,
                    x0=x0,
                    progress=progress,
                    methods=methods,
                    sparse=without_zeros,
                    own=system is not None,
                    target=target,
                    precision=precision,
                )

            with explained(f"{the_system}: cannot be measured by --backend {backend}"):
                table = measured(without_zeros=sparse)
                dense = measured(without_zeros=False) if sparse else None
    unit = table.normalised() if "standard" in table.costs else None
    rows = [
        {
            "method": method,
            "job": kind,
            **update_form(table, method),
            "unit": table.unit,
            "minimum": float(cost.minimum),
            "median": float(cost.median),
            "p95": float(cost.p95),
            **({} if dense is None else beside_dense(cost, dense.entry(method, kind))),
            **own_share(table, method, kind),
            "standard_steps": None if unit is None else float(unit.entry(method, kind).minimum),
            "standard_steps_p95": None if unit is None else float(unit.entry(method, kind).p95),
            **busy_row(table.provenance),
            **target_row(table, method),
        }
        for method, kinds in table.costs.items()
        for kind, cost in kinds.items()
    ]
    if format == "json":
        print_json(rows)
    elif format == "csv":
        print_csv(rows)
    else:
        _show(
            f"{table.name}, {'' if robust else f'{update} update, '}{'sparse, ' if sparse else ''}in "
            f"{'ns' if table.unit == 'second' else units(table.unit)}",
            rows,
            timed=table.unit == "second",
            note=lines(
                f"sparse: {in_words(structure)}" if structure is not None else "",
                own_note(table),
                busy_note(table.provenance),
                target_note(table),
                built_note(table),
            ),
        )
    if format != "table":
        say_busy(table.name, table.provenance)
    if output is not None:
        write_costs(table, output)
        say(f"Wrote {output}; use it with --costs {output}")


def beside_dense(cost: Cost, dense: Cost) -> dict[str, float]:
    """For scripts: what the same job takes with all products, and which share of that is left; by least costs."""
    return {"dense_minimum": float(dense.minimum), "of_dense": float(cost.minimum / dense.minimum)}


def _show(title: str, rows: list[dict[str, Any]], timed: bool, note: str) -> None:
    """Times in nanoseconds, operations as they are. note: more lines below."""
    shown = []
    for row in rows:
        figures = (
            {name: f"{1e9 * row[name]:.1f}" for name in ("minimum", "median", "p95")}
            if timed
            else {units(row["unit"]): " to ".join(dict.fromkeys(f"{row[name]:.0f}" for name in ("minimum", "p95")))}
        )
        steps = row["standard_steps"]
        until = f" to {row['standard_steps_p95']:.3f}" if timed and steps is not None else ""
        against = {}
        if "dense_minimum" in row:
            scale = 1e9 if timed else 1
            against = {"dense": f"{scale * row['dense_minimum']:.{int(timed)}f}", "of dense": f"{row['of_dense']:.3f}"}
        relative = {} if steps is None else {"std steps": f"{steps:.3f}{until}"}
        own = {"own, %": f"{100 * row['own_share']:.0f}"} if "own_share" in row else {}
        shown.append({"method": row["method"], "job": row["job"], **figures, **against, **own, **relative})
    related = any(row["standard_steps"] is not None for row in rows)
    ends = ", from minimum to p95; another machine may lie outside" if timed else ""
    meaning = f"std steps: relative to one propagate + update of the standard filter{ends}" if related else ""
    print_table(title, shown, lines(meaning, note))


def _robust(
    name: Literal["attitude", "position"],
    parallel: int | None,
    backend: BackendName,
    thorough: bool,
    progress: Callable[[int, int, str], None],
    target: str | None,
    precision: str | None,
) -> CostTable:
    from studies.robust.costs import parallel_costs, robust_costs

    if parallel is None:
        return robust_costs(name, backend, thorough=thorough, progress=progress, target=target, precision=precision)
    if backend != "counted":
        raise InputError(f"--parallel {parallel} is counted, not timed: give --backend counted too")
    return parallel_costs(name, parallel)
