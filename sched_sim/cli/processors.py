"""`sched-sim processors`: the processors that are known, and which of them can run a method."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.output import print_csv, print_json, print_table
from sched_sim.cli.parts import MEANING
from sched_sim.costs import Method

if TYPE_CHECKING:
    from sched_sim.processor import Processor

Parts = Annotated[
    list[str] | None,
    typer.Option(
        "--processor",
        help="Repeatable: a shipped one by name, or your own TOML file by path; by default all that are shipped.",
        rich_help_panel=opt.PROCESSOR,
    ),
]
RunMethod = Annotated[
    Method | None, typer.Option("--method", help="The filter to run; by default dual-rate.", rich_help_panel=opt.DESIGN)
]
DesignSteps = Annotated[
    int | None,
    typer.Option(
        "-N",
        help="HR steps from one measurement to the next: which processors can run the method?",
        parser=opt.whole,
        metavar="STEPS",
        rich_help_panel=opt.DESIGN,
    ),
]


def processors(
    N: DesignSteps = None,
    M: opt.Delay = None,
    L: opt.FeedbackStep = None,
    hr_hz: opt.HrHz = None,
    method: RunMethod = None,
    costs: opt.Costs = None,
    processor: Parts = None,
    format: opt.Format = "table",
) -> None:
    """The processors that are known; with -N and --hr-hz, which of them can run a method, and with how much to spare.

    sched-sim processors
    sched-sim processors -N 40 -M 20 --hr-hz 400 --method dual-rate
    """
    from sched_sim.costs import load
    from sched_sim.errors import InputError
    from sched_sim.processor import load_processor, shipped_processors

    parts = [load_processor(name) for name in dict.fromkeys(processor or shipped_processors())]
    if all(value is None for value in (N, M, L, hr_hz, method, costs)):
        rows = [_figures(part) for part in parts]
        shown = [_figures_in_words(part) for part in parts]
        title, note = "Cycles (microseconds where there is no clock) per operation", _titles(parts)
    elif N is None or hr_hz is None:
        missing = "-N" if N is None else "--hr-hz"
        raise InputError(f"{missing} is missing: which processors can run a method depends on -N and --hr-hz")
    else:
        wanted = method or "dual-rate"
        rows, shown, reasons = _verdicts(parts, N, M, L, hr_hz, wanted, costs)
        design = f"N={N} M={'none' if M is None else M} L={'latest' if L is None else L}"
        counts = opt.with_form(costs or opt.COUNTED, load(costs or opt.COUNTED))
        title = f"{wanted}, HR loop at {hr_hz} Hz, {design} (operations: {counts})"
        note = "\n".join([MEANING, *reasons])
    if format == "json":
        print_json(rows)
    elif format == "csv":
        print_csv([_flat(row) for row in rows])
    else:
        print_table(title, shown, note)


def _titles(parts: list[Processor]) -> str:
    lines = [f"{part.name}: {part.title}" for part in parts]
    return "\n".join([*lines, "", "logic: instructions around each arithmetic one. Sources: --format json"])


def _flat(row: dict[str, Any]) -> dict[str, Any]:
    """Nested figures as columns of their own, the same for every processor."""
    columns: dict[str, Any] = {}
    for key, value in row.items():
        if isinstance(value, dict):
            names = (*OPERATIONS, *OTHER_FIGURES) if key == "sources" else OPERATIONS
            columns |= {f"{key}_{name}": value.get(name) for name in names}
        else:
            columns[key] = value
    return columns


def _figures(part: Processor) -> dict[str, Any]:
    return {
        "processor": part.name,
        "title": part.title,
        "precision": part.precision,
        "clock_mhz": None if part.clock_hz is None else float(part.clock_hz / 10**6),
        "seconds": {kind: float(time) for kind, time in part.seconds.items()},
        "logic_per_arithmetic": float(part.logic_per_arithmetic),
        "sources": dict(part.sources),
    }


def _figures_in_words(part: Processor) -> dict[str, str | None]:
    scale = part.clock_hz or 10**6
    clock = None if part.clock_hz is None else f"{float(part.clock_hz / 10**6):g}"
    figures = {kind: f"{float(part.seconds[kind] * scale):g}" if kind in part.seconds else None for kind in OPERATIONS}
    return {
        "processor": part.name,
        "precision": part.precision,
        "clock, MHz": clock,
        **figures,
        "logic per arithmetic": f"{float(part.logic_per_arithmetic):.3g}",
    }


OPERATIONS = ("multiply", "add", "divide", "sqrt", "function", "logic")
OTHER_FIGURES = ("clock_mhz", "logic_per_arithmetic")


def _verdicts(
    parts: list[Processor], N: int, M: int | None, L: int | None, hr_hz: str, method: str, costs: str | None
) -> tuple[list[dict[str, Any]], list[dict[str, Any]], list[str]]:
    """A row for each processor, the same in words, and why some of them cannot be told."""
    from sched_sim.cli.parts import fit_row, fit_words
    from sched_sim.costs import select
    from sched_sim.errors import InputError
    from sched_sim.fit import fit
    from sched_sim.options import Options
    from sched_sim.ticks import positive

    rate, options = positive(hr_hz, "--hr-hz"), Options()
    timing = opt.make_timing(N, M, L, method, options)
    rows: list[dict[str, Any]] = []
    shown: list[dict[str, Any]] = []
    reasons: list[str] = []
    for part in parts:
        table, found, reason = opt.load_costs(costs, part), None, None
        try:
            found = fit(select(table, method, options), timing, rate, options)
        except InputError as error:
            if method not in table.lacking:
                raise
            reason = str(error)
            reasons.append(f"{part.name}: {reason}")
        row = {"method": method, **fit_row(part, rate, found), "reason": reason}
        rows.append(row)
        shown.append({"processor": part.name, "precision": part.precision, **fit_words(row)})
    return rows, shown, reasons
