"""What is said, and asked, of costs in instructions of an emulated core: no cycles, and what memory they need."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Annotated, Any

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.output import lines
from sched_sim.costs.table import INSTRUCTION, CostTable
from sched_sim.errors import InputError
from sched_sim.rounding import no_less
from sched_sim.ticks import positive

if TYPE_CHECKING:
    from sched_sim.processors.part import CyclesPerInstruction, Part

KB = 1024

CyclesEach = Annotated[
    str | None,
    typer.Option(
        "--cycles-per-instruction",
        help="For costs in instructions: the least and the most that one takes, mean of a job, such as 1:2; by default "
        "as the part's file states. Verdicts are by the most.",
        metavar="LEAST:MOST",
        rich_help_panel=opt.PROCESSOR,
    ),
]
ClockMhz = Annotated[
    str | None,
    typer.Option(
        "--clock-mhz",
        help="For costs in instructions, with --cycles-per-instruction: the clock of the core, instead of --processor.",
        rich_help_panel=opt.PROCESSOR,
    ),
]
RamKb = Annotated[
    str | None,
    typer.Option(
        "--ram-kb",
        help="Whether arrays and stacks of each method fit this RAM, of 1024 bytes the KB; with costs that `measure "
        "--backend emulated` wrote.",
        rich_help_panel=opt.PROCESSOR,
    ),
]


def target_note(table: CostTable) -> str:
    """A line that says what was counted where, and how it became times; empty for other costs."""
    if table.target is None:
        return ""
    about = table.provenance
    cycles = _cycles(table)
    taken = "" if cycles is None else f"; times by the most of {cycles} cycles for each"
    return (
        f"instructions, not cycles, on an emulated {table.target}, {about.get('precision')} precision, "
        f"{about.get('compiler')}{taken}"
    )


def target_row(table: CostTable, method: str) -> dict[str, Any]:
    """For scripts, of instructions: the core, and bytes that the method's tasks need."""
    if table.target is None:
        return {}
    parts = table.provenance["memory"][method].values()
    sizes = {f"{what}_bytes": sum(part[what] for part in parts) for what in ("code", "ram", "stack")}
    return {"instructions_of": table.target, **sizes}


def cycles_note(table: CostTable, part: Part) -> str:
    """A line that says how instructions became times of a part; empty for other costs."""
    if table.target is None or part.cycles_per_instruction is None:
        return ""
    return f"on {part.name}: times by the most of {part.cycles_per_instruction.text} cycles for each instruction"


def built_note(table: CostTable) -> str:
    """For people: how it was compiled, and bytes of each task; empty for other costs."""
    if table.target is None:
        return ""
    memory: Mapping[str, Mapping[str, Mapping[str, int]]] = table.provenance["memory"]
    return lines(
        f"flags: {table.provenance['flags']}",
        *(
            f"{method}: "
            + "; ".join(f"{task} code {of['code']}, RAM {of['ram']}, stack {of['stack']}" for task, of in tasks.items())
            for method, tasks in memory.items()
        ),
        str(table.provenance["memory_source"]),
    )


def part_and_costs(
    costs: str | None, processor: str | None, clock_mhz: str | None, cycles: str | None
) -> tuple[Part | None, CostTable]:
    """The part, if there is one, and the costs on it; for `minimum`.

    Raises InputError for flags that say what has no meaning with these costs, or too little.
    """
    from sched_sim.costs.table_file import load_costs
    from sched_sim.processors.part import on_part, ranged

    if clock_mhz is None and cycles is None:
        part = opt.make_processor(processor)
        table = opt.costs_on(costs, part)
        return part and ranged(table, part), table
    given = "--clock-mhz" if cycles is None else "--cycles-per-instruction"
    if costs is None or (table := load_costs(costs)).unit != INSTRUCTION:
        raise InputError(
            f"{given} is for costs in instructions: give --costs with a table that `sched-sim measure --backend "
            f"emulated` writes"
        )
    if processor is not None and clock_mhz is not None:
        raise InputError(
            f"--clock-mhz {clock_mhz} and --processor {processor} exclude each other: a part has its own clock"
        )
    if cycles is None or (clock_mhz is None and processor is None):
        missing = "--cycles-per-instruction" if cycles is None else "--clock-mhz, or --processor,"
        raise InputError(f"{missing} is missing: time of instructions is by a clock and the cycles that they take")
    if clock_mhz is None:
        part = opt.make_processor(processor)
        assert part is not None
    else:
        part = _core(table, positive(clock_mhz, "--clock-mhz"))
    part = stating(part, cycles, table)
    return ranged(table, part), on_part(table, part)


def stating(part: Part, cycles: str, table: CostTable) -> Part:
    """The part, with these cycles for instructions of the table in place of what it states."""
    return replace(part, cycles_per_instruction=_range(cycles, str(table.target)))


def suited(parts: Sequence[Part], named: Sequence[str], table: CostTable, cycles: str | None) -> list[Part]:
    """For `processors`, those that a table of instructions can be run on, of the shipped ones if none is named.

    Raises InputError for one that is named and cannot, and if there is none.
    """
    from sched_sim.processors.part import why_not_instructions

    if cycles is not None and table.unit != INSTRUCTION:
        raise InputError(
            f"--cycles-per-instruction {cycles} is for costs in instructions, and those of {table.shown} are not"
        )
    if cycles is not None and not named:
        raise InputError(
            f"--cycles-per-instruction {cycles} is of one core: name the parts that have it with --processor"
        )
    if table.unit != INSTRUCTION:
        return list(parts)
    stated = parts if cycles is None else [stating(part, cycles, table) for part in parts]
    reasons = {part.name: why_not_instructions(table, part) for part in stated}
    kept = [part for part in stated if not reasons[part.name]]
    refused = [part for part in stated if reasons[part.name]]
    if refused and (named or not kept):
        raise InputError(reasons[refused[0].name])
    return kept


def instructions_note(table: CostTable, rows: Sequence[Mapping[str, Any]], *parts: Part | None) -> str:
    """Lines below verdicts on parts: from the least to the most cycles for an instruction, what is needed of each part;
    empty for other costs."""
    return "" if table.target is None else lines(*(_needed(part, rows) for part in parts if part is not None))


def _needed(part: Part, rows: Sequence[Mapping[str, Any]]) -> str:
    assert part.cycles_per_instruction is not None
    shares = ", ".join(
        f"{row['method']} "
        + " to ".join(no_less(100 * Fraction(row[f"needed_share_{end}"]), 3) for end in ("least", "most"))
        + " %"
        for row in rows
        if row.get("processor") == part.name and row.get("needed_share_least") is not None
    )
    cycles = part.cycles_per_instruction.text
    return f"at {cycles} cycles an instruction, of the speed of {part.name}: {shares}" if shares else ""


def check_ram(table: CostTable, ram_kb: str | None) -> None:
    """Raises InputError for --ram-kb with a table that says of no method what memory it needs."""
    if ram_kb is not None and not table.provenance.get("memory"):
        raise InputError(
            f"--ram-kb {ram_kb}: cost table {table.shown} does not say what memory its methods need: use --costs with "
            f"a table that `sched-sim measure --backend emulated` writes"
        )


def in_time_and_ram(row: Mapping[str, Any]) -> dict[str, Any]:
    """A row of `board_row` in which `fits` is in time and in RAM, and `fits_time` in time; as it is where only one of
    them is known."""
    if "fits_ram" not in row or "fits" not in row:
        return dict(row)
    time, ram = row["fits"], row["fits_ram"]
    return {**row, "fits": False if not ram else time, "fits_time": time}


def board_row(table: CostTable, method: str, ram_kb: str | None = None) -> dict[str, Any]:
    """For scripts: of instructions the core, and the cycles that they were taken for; if it was asked, arrays and
    stacks of the method's tasks, and whether they fit.

    Raises InputError for a table that does not say what memory a method needs.
    """
    row: dict[str, Any] = {}
    if table.target is not None:
        row = {"instructions_of": table.target, "cycles_per_instruction": _cycles(table)}
    if ram_kb is None:
        return row
    limit = positive(ram_kb, "--ram-kb") * KB
    try:
        needed = table.memory_bytes(method)
    except InputError as error:
        raise InputError(f"--ram-kb {ram_kb}: {error}") from None
    return row | {"ram_and_stack_bytes": needed, "fits_ram": needed <= limit}


def _cycles(table: CostTable) -> str | None:
    processor = table.provenance.get("processor")
    return processor.get("cycles_per_instruction") if isinstance(processor, Mapping) else None


def ram_words(row: Mapping[str, Any]) -> dict[str, str | None]:
    """Memory of a `board_row` in words, and the verdict where it has one: "fits" is in time and in RAM."""
    if "fits_ram" not in row:
        return {}
    words = {True: "yes", False: "no", None: None}
    verdict = {"fits": words[row["fits"]], "in time": words[row["fits_time"]]} if "fits_time" in row else {}
    return verdict | {"RAM, KB": no_less(Fraction(row["ram_and_stack_bytes"], KB), 3), "in RAM": words[row["fits_ram"]]}


def _core(table: CostTable, clock_mhz: Fraction) -> Part:
    """A part of which no more is known than its core and its clock."""
    from sched_sim.processors.part import Part

    name = str(table.target)
    title = f"{name} at {float(clock_mhz):g} MHz"
    return Part(name, title, "unstated", clock_mhz * 10**6, {}, Fraction(0), {})


def _range(text: str, target: str) -> CyclesPerInstruction:
    from sched_sim.processors.part import CyclesPerInstruction

    least_text, colon, most_text = text.partition(":")
    least = positive(least_text, "--cycles-per-instruction")
    most = positive(most_text, "--cycles-per-instruction") if colon else least
    if most < least:
        raise InputError(f"--cycles-per-instruction {text}: the most, {most_text}, is less than the least: give 1:2")
    return CyclesPerInstruction(least, most, target, "--cycles-per-instruction")
