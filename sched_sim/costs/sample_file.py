"""Measured execution times of a filter's parts, one number for each execution: the file that `sched-sim measure
--filter` writes and a scenario reads. Numbers are read as exact decimals, from a list or from a text."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    ValidationError,
    ValidatorFunctionWrapHandler,
    WrapValidator,
    model_validator,
)

from sched_sim.costs.documents import CORRECT, PREDICT, refuse_cost_table
from sched_sim.costs.operations import Counts, arithmetic
from sched_sim.costs.sample_text import of_each, samples_in, samples_value
from sched_sim.costs.table import SECONDS
from sched_sim.costs.table_file import CountsOfJob, Number
from sched_sim.errors import InputError
from sched_sim.files.toml_problems import problems
from sched_sim.files.toml_reader import read_toml
from sched_sim.files.toml_writer import toml_key, toml_tables, toml_value
from sched_sim.files.writable import write


@dataclass(frozen=True)
class SampledCosts:
    """What each execution of each part of a filter took, all in one `unit` ("second", "ms", "operation").

    samples: by part, each one execution, at least one: "predict" (one step), "predict_accumulate" (one that also
    multiplies the transition, for Larsen's method), and with the sensor's name behind a dot "correct.gps" (one
    measurement), "correct_accumulate.gps" (one while another measurement is on its way, Larsen) and
    "correct_late.gps" (the late one itself, Larsen). With several late measurements in flight also what each costs in a
    step, "carry.gps", what it adds to a correction by the gps, "beside.gps", and its landing, "land.gps"; where
    products of transitions are carried (Larsen), "carry_product", "beside_product.gps" and "land_product.gps". Of the
    dual-rate filter "hr_propagate" (one step of its high-rate task), "hr_restart" (one after a measurement was taken),
    "hr_update" (a landing), "hr_pass.gps" (its way past a measurement of the gps), and of its low-rate task
    "lr_propagate" (from a measurement to the next), "gain.gps", "lr_correct.gps" (on arrival) and, after a loss,
    "gain_again.gps", and "gain_kept.gps" where the correction has landed.
    operations: counts by the same parts, where they are known; with the unit "operation" the samples may be left out,
    and each part has one: its arithmetic.
    provenance: whatever else the file says, such as `executions`, whether each sample is one execution, timed by
    itself, in the order of `samples`; and `autocorrelation`, by part, see `rank_autocorrelation`. path: where it was
    read from, for messages.
    Raises InputError for a part that does not exist or has no samples.
    """

    name: str
    unit: str
    samples: Mapping[str, tuple[Fraction, ...]]
    operations: Mapping[str, Counts] = field(default_factory=dict)
    provenance: Mapping[str, Any] = field(default_factory=dict)
    path: str = ""

    def __post_init__(self) -> None:
        for part in (*self.samples, *self.operations):
            kind, _, sensor = part.partition(".")
            if not (part in PREDICT or (kind in CORRECT and sensor)):
                known = ", ".join([*PREDICT, *(f"{kind}.SENSOR" for kind in CORRECT)])
                raise InputError(f"sampled costs {self.shown}: {part!r} is no part of a filter: choose from {known}")
        for part, values in self.samples.items():
            if not values or not all(of_each(_is_positive, values)):
                raise InputError(
                    f"sampled costs {self.shown}: samples of {part} must be one or more numbers greater than 0"
                )

    @property
    def harness(self) -> bool:
        """Whether an earlier `measure --filter` timed the samples, several executions in each: most of such a sample is
        the loop that timed it."""
        timed = self.unit in SECONDS and self.provenance.get("backend") == "compiled"
        return timed and not self.provenance.get("executions")

    @property
    def shown(self) -> str:
        """Name and path, for messages."""
        return f"{self.name!r} ({self.path})" if self.path else repr(self.name)


def _is_positive(sample: Fraction) -> bool:
    return sample.numerator > 0


def _listed_or_text(value: Any, listed: ValidatorFunctionWrapHandler) -> Any:
    return samples_in(value) if isinstance(value, str) and value.strip() else listed(value)


_Samples = Annotated[list[Number], Field(min_length=1), WrapValidator(_listed_or_text)]


class _SampleTables(BaseModel):
    model_config = ConfigDict(extra="forbid", arbitrary_types_allowed=True)
    predict: _Samples | None = None
    predict_accumulate: _Samples | None = None
    carry_product: _Samples | None = None
    hr_propagate: _Samples | None = None
    hr_restart: _Samples | None = None
    hr_update: _Samples | None = None
    lr_propagate: _Samples | None = None
    correct: dict[str, _Samples] = {}
    correct_accumulate: dict[str, _Samples] = {}
    correct_late: dict[str, _Samples] = {}
    carry: dict[str, _Samples] = {}
    beside: dict[str, _Samples] = {}
    land: dict[str, _Samples] = {}
    beside_product: dict[str, _Samples] = {}
    land_product: dict[str, _Samples] = {}
    gain: dict[str, _Samples] = {}
    gain_again: dict[str, _Samples] = {}
    gain_kept: dict[str, _Samples] = {}
    lr_correct: dict[str, _Samples] = {}
    hr_pass: dict[str, _Samples] = {}


class _OperationTables(BaseModel):
    model_config = ConfigDict(extra="forbid")
    predict: CountsOfJob | None = None
    predict_accumulate: CountsOfJob | None = None
    carry_product: CountsOfJob | None = None
    hr_propagate: CountsOfJob | None = None
    hr_restart: CountsOfJob | None = None
    hr_update: CountsOfJob | None = None
    lr_propagate: CountsOfJob | None = None
    correct: dict[str, CountsOfJob] = {}
    correct_accumulate: dict[str, CountsOfJob] = {}
    correct_late: dict[str, CountsOfJob] = {}
    carry: dict[str, CountsOfJob] = {}
    beside: dict[str, CountsOfJob] = {}
    land: dict[str, CountsOfJob] = {}
    beside_product: dict[str, CountsOfJob] = {}
    land_product: dict[str, CountsOfJob] = {}
    gain: dict[str, CountsOfJob] = {}
    gain_again: dict[str, CountsOfJob] = {}
    gain_kept: dict[str, CountsOfJob] = {}
    lr_correct: dict[str, CountsOfJob] = {}
    hr_pass: dict[str, CountsOfJob] = {}


class _SampleFile(BaseModel):
    model_config = ConfigDict(extra="allow")
    name: str
    unit: str
    samples: _SampleTables = _SampleTables()
    operations: _OperationTables = _OperationTables()

    @model_validator(mode="after")
    def _something_to_draw_from(self) -> Self:
        if not _flat(self.samples) and (self.unit != "operation" or not _flat(self.operations)):
            raise ValueError(
                f"no [samples] (unit {self.unit!r}): give `predict = [...]` there and [samples.correct], or with "
                f'unit = "operation" the same entries under [operations]'
            )
        return self


def read_sampled_costs(path: Path, shown: str = "") -> SampledCosts:
    """The costs in `path`; `shown` is what the user called it.

    Raises InputError that lists every wrong entry of the file with its value.
    """
    shown = shown or str(path)
    document = read_toml(path, f"costs {shown!r}", "give the path of a file that `sched-sim measure --filter` writes")
    refuse_cost_table(document, f"costs {shown!r}")
    try:
        checked = _SampleFile.model_validate(document)
    except ValidationError as error:
        raise InputError(f"costs {shown!r}: {problems(error, _SampleFile)}") from None
    samples = {part: tuple(values) for part, values in _flat(checked.samples).items()}
    operations = _flat(checked.operations)
    samples = samples or {part: (Fraction(arithmetic(counts)),) for part, counts in operations.items()}
    return SampledCosts(checked.name, checked.unit, samples, operations, dict(checked.model_extra or {}), shown)


def sampled_costs_text(costs: SampledCosts) -> str:
    """`costs` as the TOML text that `read_sampled_costs` reads back; exact where they are decimals."""
    lines = [f"name = {toml_value(costs.name)}", f"unit = {toml_value(costs.unit)}"]
    tables: list[str] = []
    for key, value in costs.provenance.items():
        if isinstance(value, Mapping):
            tables += toml_tables(key, value)
        else:
            lines.append(f"{toml_key(key)} = {toml_value(value)}")
    samples = {part: samples_value(values) for part, values in costs.samples.items()}
    counts = {part: toml_value(counts) for part, counts in costs.operations.items()}
    return "\n".join([*lines, *tables, *_nested("samples", samples), *_nested("operations", counts)]) + "\n"


def write_sampled_costs(costs: SampledCosts, path: Path) -> None:
    """Raises InputError if the path cannot be written."""
    write(path, sampled_costs_text(costs).encode(), "costs")


def _flat(tables: _SampleTables | _OperationTables) -> dict[str, Any]:
    """The entries by part, "correct.gps"."""
    entries: dict[str, Any] = {part: entry for part in PREDICT if (entry := getattr(tables, part)) is not None}
    for kind in CORRECT:
        entries |= {f"{kind}.{sensor}": entry for sensor, entry in getattr(tables, kind).items()}
    return entries


def _nested(table: str, entries: Mapping[str, str]) -> list[str]:
    """The lines of [table] and [table.correct] ..., with the entries by part as they are to be written."""
    if not entries:
        return []
    lines = ["", f"[{table}]", *(f"{part} = {entries[part]}" for part in PREDICT if part in entries)]
    for kind in CORRECT:
        of_kind = [f"{toml_key(part.partition('.')[2])} = {text}" for part, text in entries.items()
                   if part.startswith(f"{kind}.")]  # fmt: skip
        lines += ["", f"[{table}.{kind}]", *of_kind] if of_kind else []
    return lines
