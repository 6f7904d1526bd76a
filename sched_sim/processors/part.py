"""A processor by its data sheet: operation counts become time. Everything is exact.

One rule for the shipped files. A processor that issues in order waits for each result: arithmetic is charged its
latency, for the product of a dot product is wanted by its add, and that by the next add. One that works out of order
overlaps the dot products: arithmetic is charged its throughput. Logic is charged what it takes to issue, for nothing
waits for the next index. No operations overlap otherwise. What is left out goes both ways: fused multiply-adds and
vector instructions make a processor faster; misses of its caches, wait states of its memory, calls and copies around
the algebra make it slower.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from sched_sim.bounds import check_kind
from sched_sim.costs.operations import Counts, arithmetic
from sched_sim.costs.table import INSTRUCTION, Cost, CostTable
from sched_sim.errors import InputError, option

FUNCTION = {"multiply": 13, "add": 17}
"""What a function (sin, cos, exp, ...) is charged as on a processor whose file does not time it: the cosine of fdlibm,
its polynomial (k_cos.c) and the first step of the reduction of its argument (e_rem_pio2.c)."""


class NoTimeError(InputError):
    """A processor's file does not time some operations. operations: which."""

    def __init__(self, message: str, operations: Sequence[str] = ()) -> None:
        super().__init__(message)
        self.operations = tuple(operations)


OF_TIMES = ("busy", "protocol")
"""What a cost table says of times that were measured, and that is not true of those of a part."""


@dataclass(frozen=True)
class Calibration:
    """Measured over predicted on a part, at least and at most; source: which jobs of whose, on which board."""

    least: Fraction
    most: Fraction
    source: str = ""

    @property
    def text(self) -> str:
        """Of people: "0.68 to 1.05 (KFCore, STM32F429)"."""
        ends = " to ".join(dict.fromkeys(f"{float(end):.3g}" for end in (self.least, self.most)))
        return f"{ends} ({self.source})" if self.source else ends


@dataclass(frozen=True)
class CyclesPerInstruction:
    """What instructions of a core, the mean of a job's, take at least and at most.

    target: the core, as `sched-sim measure --target` names it.
    """

    least: Fraction
    most: Fraction
    target: str
    source: str = ""

    @property
    def text(self) -> str:
        """Of people: "1 to 2"."""
        return " to ".join(dict.fromkeys(f"{float(end):.3g}" for end in (self.least, self.most)))


@dataclass(frozen=True)
class Part:
    """What each kind of operation takes on one processor.

    seconds: by kind of operation (`operations.OPERATION_KINDS`), those that the file gives. clock_hz: None if the file
    gives times instead of cycles. precision: of the arithmetic, "single" or "double". logic_per_arithmetic: logic
    operations around each arithmetic one, for jobs that do not count their own. sources: where each figure is from,
    by its name in the file. path: where the file was read from, for messages. calibration: of code that multiplies
    zeros, sparse_calibration: of code that leaves them out; None where nothing was measured; they change no time.
    price: of one, in whatever currency all files have it; None where it is not known. for_sale: not where it is the
    machine of a publication, which is named only where no other does.
    cycles_per_instruction: for tables of instructions; None where it is not stated.
    """

    name: str
    title: str
    precision: str
    clock_hz: Fraction | None
    seconds: Mapping[str, Fraction]
    logic_per_arithmetic: Fraction
    sources: Mapping[str, str]
    path: str = ""
    calibration: Calibration | None = None
    sparse_calibration: Calibration | None = None
    price: Fraction | None = None
    for_sale: bool = True
    cycles_per_instruction: CyclesPerInstruction | None = None


def on_part(table: CostTable, processor: Part) -> CostTable:
    """The jobs of `table` whose operations are counted, with the seconds that `processor` takes for them.

    A job's time is the sum over its operations, one after another. Logic that a job does not count is
    `logic_per_arithmetic` for each arithmetic operation, a function that the processor does not time is `FUNCTION`. A
    job with another kind of operation that it does not give has no cost: `CostTable.entry` raises InputError for it.
    Instructions take the most cycles that are stated for them.
    Raises InputError for a table without counts, and for instructions of another core or precision.
    """
    check_kind(table, CostTable, "table", "a cost table, as `load_costs` returns it")
    check_kind(processor, Part, "processor", "a part, as `load_part` returns it")
    if table.unit == INSTRUCTION:
        return _instructions_on_part(table, processor)
    if not table.operations:
        raise InputError(
            f"cost table {table.shown} has no operation counts to run on processor {processor.name!r}: use "
            f"{option('costs')} counted-9-3-3, or count with `sched-sim measure --backend counted -o FILE`"
        )
    costs: dict[str, dict[str, Cost]] = {}
    lacking: dict[str, dict[str, str]] = {}
    for method, entries in table.operations.items():
        for kind, counts in entries.items():
            try:
                time = seconds_for(counts, processor, f"[operations.{method}] {kind} of cost table {table.shown}")
                costs.setdefault(method, {})[kind] = Cost.of(time)
            except InputError as error:
                lacking.setdefault(method, {})[kind] = str(error)
    return replace(
        table,
        name=f"{table.name} on {processor.name}",
        unit="second",
        costs=costs,
        provenance={
            **{key: value for key, value in table.provenance.items() if key not in OF_TIMES},
            "machine": processor.title,
            "processor": _about(processor, calibration_for(table, processor)),
        },
        lacking=lacking,
    )


def _instructions_on_part(table: CostTable, processor: Part) -> CostTable:
    if why := why_not_instructions(table, processor):
        raise InputError(why)
    assert processor.cycles_per_instruction is not None
    assert processor.clock_hz is not None
    rate = processor.clock_hz / processor.cycles_per_instruction.most
    costs = {method: {kind: cost / rate for kind, cost in kinds.items()} for method, kinds in table.costs.items()}
    about = _about(replace(processor, sources={}), None)
    source = processor.cycles_per_instruction.source
    return replace(
        table,
        name=f"{table.name} on {processor.name}",
        unit="second",
        costs=costs,
        provenance={
            **table.provenance,
            "machine": processor.title,
            "processor": {
                **about,
                "cycles_per_instruction": processor.cycles_per_instruction.text,
                **({"cycles_per_instruction_source": source} if source else {}),
            },
        },
    )


def why_not_instructions(table: CostTable, processor: Part) -> str:
    """Why a table of instructions cannot become times on a processor; empty if it can."""
    if table.target is None:
        return f"cost table {table.shown} does not say of which core its instructions are: add the line `target = ...`"
    said = f"cost table {table.shown} has instructions of {table.target}"
    stated = processor.cycles_per_instruction
    if processor.clock_hz is None:
        return f"{said}, and processor {processor.name!r} has no clock: choose another, or give clock_mhz in its file"
    if stated is None or stated.target != table.target:
        return (
            f"{said}, and processor {processor.name!r} does not state the cycles of such: choose another, or state "
            f"them in [cycles_per_instruction] of its file, or with {option('cycles_per_instruction')}"
        )
    precision = table.provenance.get("precision")
    if processor.precision != "unstated" and precision not in (None, processor.precision):
        return f"{said} in {precision} precision, and processor {processor.name!r} computes in {processor.precision}"
    return ""


def calibration_for(table: CostTable, processor: Part) -> Calibration | None:
    """What was measured of such code as the table counts: loops that multiply zeros say nothing of code without."""
    return processor.sparse_calibration if table.structure == "sparse" else processor.calibration


def ranged(table: CostTable, processor: Part) -> Part:
    """The processor, whose calibration is what it may take over what costs of this table say: of instructions, which
    are charged the most cycles, from the least cycles to those; of sparse counts none where one timing is no range."""
    stated = processor.cycles_per_instruction
    if table.target is not None:
        return processor if stated is None else replace(processor, calibration=_of_cycles(stated))
    known = calibration_for(table, processor)
    if table.structure == "sparse" and known is not None and known.least == known.most:
        known = None
    return replace(processor, calibration=known)


def _of_cycles(stated: CyclesPerInstruction) -> Calibration:
    return Calibration(stated.least / stated.most, Fraction(1))


def seconds_for(counts: Counts, processor: Part, job: str) -> Fraction:
    """What `processor` takes for one job's operations, one after another. job: how messages name it.

    Raises NoTimeError for a kind of operation that it does not give a time for.
    """
    needed = _needed(counts, processor)
    if missing := without_time(counts, processor):
        raise NoTimeError(_no_time(processor, missing, job), missing)
    return sum((number * processor.seconds[operation] for operation, number in needed.items()), Fraction(0))


def without_time(counts: Counts, processor: Part) -> list[str]:
    """The operations of a job for which the processor's file has no time."""
    return [operation for operation in _needed(counts, processor) if operation not in processor.seconds]


def at_clock(processor: Part, clock_hz: Fraction) -> Part:
    """The same processor at another clock, Hz: it takes as many cycles.

    Raises InputError for a processor whose file gives times instead of cycles.
    """
    if processor.clock_hz is None:
        raise InputError(
            f"processor {processor.name!r} has no clock, its file gives [microseconds]: give [cycles] and clock_mhz in "
            f"a copy of it"
        )
    slower = processor.clock_hz / clock_hz
    return replace(
        processor,
        title=f"{processor.name} at {float(clock_hz / 10**6):g} MHz",
        clock_hz=clock_hz,
        seconds={kind: time * slower for kind, time in processor.seconds.items()},
    )


def _needed(counts: Counts, processor: Part) -> dict[str, Fraction]:
    """How many of each operation a job takes, its logic included."""
    if "function" in counts and "function" not in processor.seconds:
        counts = _without_functions(counts)
    logic = Fraction(counts.get("logic", processor.logic_per_arithmetic * arithmetic(counts)))
    needed = {kind: Fraction(number) for kind, number in counts.items()} | {"logic": logic}
    return {kind: number for kind, number in needed.items() if number}


def _without_functions(counts: Counts) -> Counts:
    functions = counts["function"]
    more = {kind: counts.get(kind, 0) + functions * number for kind, number in FUNCTION.items()}
    return {kind: number for kind, number in counts.items() if kind != "function"} | more


def _no_time(processor: Part, missing: Sequence[str], job: str) -> str:
    section = "microseconds" if processor.clock_hz is None else "cycles"
    where = f"{processor.name!r} ({processor.path})" if processor.path else repr(processor.name)
    lines = " and ".join(f"`{operation} = ...`" for operation in missing)
    return (
        f"processor {where} gives no time for {' and '.join(missing)}, which {job} needs: add the line {lines} to "
        f"[{section}] in a copy of its file, or choose another processor"
    )


def _about(processor: Part, calibration: Calibration | None) -> dict[str, str]:
    """What a cost table says of the processor that its times are for."""
    clock = {} if processor.clock_hz is None else {"clock_mhz": str(processor.clock_hz / 10**6)}
    return {
        "name": processor.name,
        "precision": processor.precision,
        **clock,
        "logic_per_arithmetic": str(processor.logic_per_arithmetic),
        **({} if calibration is None else {"calibration": calibration.text}),
        **{f"{figure}_source": source for figure, source in processor.sources.items() if source},
    }
