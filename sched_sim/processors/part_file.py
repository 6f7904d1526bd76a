"""Reading a processor's TOML file. Numbers are read as exact decimals, or as quotients in a string."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    StrictBool,
    ValidationError,
    model_validator,
)

from sched_sim.costs.operations import OPERATION_KINDS
from sched_sim.errors import InputError, option
from sched_sim.files.kinds import refuse_other_kind
from sched_sim.files.toml_problems import problems
from sched_sim.files.toml_reader import read_toml
from sched_sim.processors.part import Calibration, CyclesPerInstruction, Part
from sched_sim.text import did_you_mean
from sched_sim.ticks import exact, positive

SHIPPED = Path(__file__).parent

HERTZ_PER_MHZ = 10**6
MICROSECONDS_PER_SECOND = 10**6


def _value(value: Any) -> Fraction:
    if isinstance(value, bool | list | dict):
        raise ValueError("must be a number")
    return exact(value, "the number")


_Number = Annotated[Fraction, BeforeValidator(_value)]


class _Figure(BaseModel):
    """One number of a data sheet: what it is and where it is printed."""

    model_config = ConfigDict(extra="forbid", arbitrary_types_allowed=True)
    value: _Number
    is_: Annotated[Literal["latency", "throughput", "time"] | None, Field(alias="is")] = None
    source: str = ""

    @property
    def text(self) -> str:
        return ": ".join(part for part in (self.is_, self.source) if part)


class _Cycles(_Figure):
    value: _Number = Field(alias="cycles")


class _Microseconds(_Figure):
    value: _Number = Field(alias="microseconds")


class _Calibration(BaseModel):
    model_config = ConfigDict(extra="forbid", arbitrary_types_allowed=True)
    least: _Number
    most: _Number
    source: str = ""

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        positive(self.least, "least")
        if self.most < self.least:
            raise ValueError(f"most is {self.most}: it must be at least least, {self.least}")
        return self


class _CyclesPerInstruction(_Calibration):
    target: str


def _range(value: Any) -> Any:
    """A plain number stands for a range of one."""
    return value if isinstance(value, dict) else {"least": value, "most": value}


def _figure(key: str) -> BeforeValidator:
    """A plain number stands for a figure without a source."""
    return BeforeValidator(lambda value: value if isinstance(value, dict) else {key: value})


def _positive(figure: _Figure) -> _Figure:
    positive(figure.value, "the number")
    return figure


def _not_negative(figure: _Figure) -> _Figure:
    if figure.value < 0:
        raise ValueError(f"the number is {figure.value}: it must be 0 or more")
    return figure


def _known_kinds(figures: dict[str, Any]) -> dict[str, Any]:
    for kind in figures:
        if kind not in OPERATION_KINDS:
            raise ValueError(f"{kind} is no kind of operation: choose from {', '.join(OPERATION_KINDS)}")
    return figures


_InCycles = Annotated[
    dict[str, Annotated[_Cycles, _figure("cycles"), AfterValidator(_positive)]], AfterValidator(_known_kinds)
]
_InMicroseconds = Annotated[
    dict[str, Annotated[_Microseconds, _figure("microseconds"), AfterValidator(_positive)]],
    AfterValidator(_known_kinds),
]


class _ProcessorFile(BaseModel):
    model_config = ConfigDict(extra="forbid")
    name: str
    title: str
    precision: Literal["single", "double", "unstated"]
    clock_mhz: Annotated[_Figure, _figure("value"), AfterValidator(_positive)] | None = None
    logic_per_arithmetic: Annotated[_Figure, _figure("value"), AfterValidator(_not_negative)]
    calibration: Annotated[_Calibration, BeforeValidator(_range)] | None = None
    sparse_calibration: Annotated[_Calibration, BeforeValidator(_range)] | None = None
    cycles_per_instruction: _CyclesPerInstruction | None = None
    price: Annotated[_Number, AfterValidator(lambda price: positive(price, "the number"))] | None = None
    for_sale: StrictBool = True
    cycles: _InCycles = {}
    microseconds: _InMicroseconds = {}

    @model_validator(mode="after")
    def _cycles_or_times(self) -> Self:
        if bool(self.cycles) == bool(self.microseconds):
            raise ValueError("give either [cycles] with clock_mhz, or [microseconds]")
        if self.cycles and not self.clock_mhz:
            raise ValueError("[cycles] need the clock: add the line `clock_mhz = ...`, or give [microseconds]")
        if self.microseconds and self.clock_mhz:
            raise ValueError("clock_mhz has no meaning for [microseconds]: delete it, or give [cycles]")
        if self.cycles_per_instruction and not self.clock_mhz:
            raise ValueError("[cycles_per_instruction] need the clock: give clock_mhz and [cycles]")
        if self.logic_per_arithmetic.value and "logic" not in self.figures:
            raise ValueError("logic_per_arithmetic needs the time of one: add the line `logic = ...`, or set it to 0")
        return self

    @property
    def figures(self) -> Mapping[str, _Figure]:
        return self.cycles or self.microseconds


def shipped_parts() -> list[str]:
    """The names of the processors that come with the project."""
    return sorted(path.stem for path in SHIPPED.glob("*.toml"))


def load_part(name_or_path: str | Path) -> Part:
    """A shipped processor by its name, or a user's own by the path of its file.

    Raises InputError that names the file, every wrong entry in it, and the remedy.
    """
    text = str(name_or_path)
    path = SHIPPED / f"{text}.toml" if text in shipped_parts() else Path(text)
    return read_part(path, shown=text)


def read_part(path: Path, shown: str = "", argument: str | None = None) -> Part:
    """The processor in `path`; `shown` is what the user called it, `argument` what named it, for messages.

    Raises InputError that lists every wrong entry of the file with its value.
    """
    shown = shown or str(path)
    said = f"{argument or option('processor')} {shown!r}"
    shipped = shipped_parts()
    remedy = f"{did_you_mean(shown, shipped)}give one of {', '.join(shipped)}, or the path of a TOML file"
    document = read_toml(path, said, remedy)
    refuse_other_kind(document, said, "processor")
    try:
        checked = _ProcessorFile.model_validate(document)
    except ValidationError as error:
        raise InputError(f"{said}: {problems(error, _ProcessorFile)}") from None
    clock_hz = checked.clock_mhz.value * HERTZ_PER_MHZ if checked.clock_mhz else None
    per_second = clock_hz or Fraction(MICROSECONDS_PER_SECOND)
    named = {**checked.figures, "logic_per_arithmetic": checked.logic_per_arithmetic}
    if checked.clock_mhz:
        named["clock_mhz"] = checked.clock_mhz
    return Part(
        name=checked.name,
        title=checked.title,
        precision=checked.precision,
        clock_hz=clock_hz,
        seconds={kind: figure.value / per_second for kind, figure in checked.figures.items()},
        logic_per_arithmetic=checked.logic_per_arithmetic.value,
        sources={name: figure.text for name, figure in named.items()},
        path=shown,
        calibration=_calibration(checked.calibration),
        sparse_calibration=_calibration(checked.sparse_calibration),
        price=checked.price,
        for_sale=checked.for_sale,
        cycles_per_instruction=(
            None
            if checked.cycles_per_instruction is None
            else CyclesPerInstruction(**dict(checked.cycles_per_instruction))
        ),
    )


def _calibration(checked: _Calibration | None) -> Calibration | None:
    return None if checked is None else Calibration(**dict(checked))
