"""`sched-sim processors`: the processors that are known, and which of them can run a method."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.output import print_csv, print_json, print_table

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
    method: opt.OneMethod = "dual-rate",
    costs: opt.Costs = None,
    processor: Parts = None,
    format: opt.Format = "table",
) -> None:
    """The processors that are known; with -N and --hr-hz, which of them can run a method, and with how much to spare.

    sched-sim processors
    sched-sim processors -N 40 -M 20 --hr-hz 400 --method dual-rate
    """
    from sched_sim.errors import InputError
    from sched_sim.processor import load_processor, shipped_processors

    parts = [load_processor(name) for name in processor or shipped_processors()]
    if N is None and hr_hz is None:
        rows = [_figures(part) for part in parts]
        shown = [_figures_in_words(part) for part in parts]
        title, note = "Processors: cycles (or microseconds) per operation", NOTE
    elif N is None or hr_hz is None:
        missing = "-N" if N is None else "--hr-hz"
        raise InputError(f"{missing} is missing: which processors can run {method} depends on -N and --hr-hz")
    else:
        rows, shown, reasons = _verdicts(parts, N, M, L, hr_hz, method, costs)
        title, note = f"{method}, N={N} M={'none' if M is None else M}, HR loop at {hr_hz} Hz", "\n".join(reasons)
    if format == "json":
        print_json(rows)
    elif format == "csv":
        print_csv(rows)
    else:
        print_table(title, shown, note)


NOTE = "logic: operations around each arithmetic one. Each figure's source: --format json"


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
        "what it is": part.title,
        "precision": part.precision,
        "clock, MHz": clock,
        **figures,
        "logic per arithmetic": f"{float(part.logic_per_arithmetic):.3g}",
    }


OPERATIONS = ("multiply", "add", "divide", "sqrt", "function", "logic")


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
            reasons.append(reason)
        row = {"method": method, **fit_row(part, rate, found), "reason": reason}
        rows.append(row)
        shown.append({"processor": part.name, "precision": part.precision, **fit_words(row)})
    return rows, shown, reasons
