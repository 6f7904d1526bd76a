"""Reading distributions of costs from TOML: `[distribution]` by kind of job, or the samples of one filter's parts."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, model_validator

from sched_sim.costs.methods import KINDS
from sched_sim.costs.sample_file import SampledCosts, read_sampled_costs
from sched_sim.costs.table import SECONDS
from sched_sim.errors import InputError, option
from sched_sim.files.toml_numbers import Positive
from sched_sim.files.toml_problems import problems
from sched_sim.files.toml_reader import read_toml
from sched_sim.probability.stated import StatedCost, by_exceedance, probability, with_the_rest
from sched_sim.text import did_you_mean

PARTS: Mapping[str, Mapping[str, str]] = {
    "standard": {"propagate": "predict", "update": "correct"},
    "recalculate": {"propagate": "predict", "update": "correct", "replay": "predict"},
    "larsen": {"propagate": "predict", "propagate_accumulate": "predict_accumulate", "update": "correct_late"},
    "carried-gain": {"propagate": "predict", "update": "correct", "carry": "carry", "land": "land"},
    "dual-rate": {
        **{kind: kind for kind in ("hr_propagate", "hr_restart", "hr_update", "lr_propagate", "lr_correct")},
        "lr_gain": "gain",
    },
}
"""By method and kind of job: the part of a filter with one sensor whose execution such a job is."""


def _probability(value: Any) -> Fraction:
    if isinstance(value, bool) or not (isinstance(value, int | Decimal) or (isinstance(value, str) and "/" in value)):
        raise ValueError("must be a number from 0 to 1")
    return probability(value, "the probability")


_Probability = Annotated[Fraction, BeforeValidator(_probability)]
_Values = Annotated[list[Positive], Field(min_length=1)]


class _Distribution(BaseModel):
    model_config = ConfigDict(extra="forbid", arbitrary_types_allowed=True)
    samples: _Values | None = None
    values: _Values | None = None
    probabilities: list[_Probability] | None = None
    exceedance: list[_Probability] | None = None
    worst: Positive | None = None

    @model_validator(mode="after")
    def _one_of_three(self) -> Self:
        given = [name for name in ("samples", "probabilities", "exceedance") if getattr(self, name) is not None]
        if len(given) != 1 or (self.values is None) != (given == ["samples"]):
            raise ValueError(
                "give samples = [...], or values = [...] with probabilities = [...], or with exceedance = [...], the "
                "probabilities that more is taken"
            )
        return self

    def stated(self, source: str, scale: Fraction) -> StatedCost:
        worst = None if self.worst is None else scale * self.worst
        values = [scale * value for value in self.samples or self.values or ()]
        if self.samples is not None:
            return StatedCost(values, None, worst, source=source)
        if self.exceedance is not None:
            return by_exceedance(values, self.exceedance, worst, source)
        probabilities = [*(self.probabilities or ()), *[None] * (len(values) == 1 + len(self.probabilities or ()))]
        return StatedCost(values, with_the_rest(probabilities, source), worst, source=source)


class _DistributionFile(BaseModel):
    model_config = ConfigDict(extra="allow")
    unit: str
    distribution: Annotated[dict[str, _Distribution], Field(min_length=1)]


def read_cost_distributions(path: Path, method: str, unit: str) -> dict[str, StatedCost]:
    """By kind of job of this method, in this unit. A file of samples has one sensor.

    Raises InputError that lists every wrong entry of the file with its value, for kinds that the method does not have,
    and for a unit that is not the other one in other words.
    """
    what = f"{option('distributions')} {str(path)!r}"
    document = read_toml(path, what, "give the path of a TOML file with [distribution.KIND], or of samples")
    if not document.keys() & {"distribution", "samples", "operations", "costs"}:
        raise InputError(
            f"{what} has no [distribution.KIND] and no [samples]: write unit = ... and for each kind of job that is "
            f"random [distribution.KIND] with samples = [...], or values = [...] and probabilities = [...]"
        )
    if "distribution" not in document:
        return _of_samples(read_sampled_costs(path, str(path)), method, unit, what)
    try:
        checked = _DistributionFile.model_validate(document)
    except ValidationError as error:
        raise InputError(f"{what}: {problems(error, _DistributionFile, document)}") from None
    scale = scale_of(checked.unit, unit, what)
    for kind in checked.distribution:
        check_kind_of_job(kind, method, f"{what}: [distribution.{kind}]")
    return {kind: entry.stated(f"{what}: [distribution.{kind}]", scale) for kind, entry in checked.distribution.items()}


def check_kind_of_job(kind: str, method: str, what: str) -> None:
    """Raises InputError, with those that there are, for one that the method does not have."""
    if kind not in KINDS[method]:
        known = KINDS[method]
        raise InputError(
            f"{what}: {method} has no such kind of job: {did_you_mean(kind, known)}choose from {', '.join(known)}"
        )


def scale_of(unit: str, wanted: str, what: str) -> Fraction:
    """How many of the units that are wanted one is. Raises InputError for units of which one is no time."""
    if unit == wanted:
        return Fraction(1)
    if unit in SECONDS and wanted in SECONDS:
        return SECONDS[unit] / SECONDS[wanted]
    raise InputError(
        f"{what} is in {unit}, and costs are in {wanted} here: give {option('costs')} a table in a unit of time "
        f"({', '.join(SECONDS)}), or {option('processor')}, and the distributions in one too, or both in {wanted}"
    )


def _of_samples(sampled: SampledCosts, method: str, unit: str, what: str) -> dict[str, StatedCost]:
    """What its parts are to the method; those that are to none are left."""
    if method not in PARTS:
        raise InputError(
            f"{what}: these are samples of a composed filter's parts, of which {method} has none: write a file with "
            f"[distribution.KIND], or choose {option('method')} {', '.join(PARTS)}"
        )
    sensors = list(dict.fromkeys(sensor for part in sampled.samples if (sensor := part.partition(".")[2])))
    if len(sensors) > 1:
        raise InputError(
            f"{what} has parts of {len(sensors)} sensors, {', '.join(sensors)}, and a design has one: write a file "
            f"with [distribution.KIND], or `sched-sim simulate --scenario` for all"
        )
    if sampled.harness:
        raise InputError(
            f"{what}: most of such a sample is the loop that timed it, and no probability follows from it: measure "
            f"anew, `sched-sim measure --filter` times each execution"
        )
    scale, found = scale_of(sampled.unit, unit, what), {}
    correlations = sampled.provenance.get("autocorrelation")
    for kind, part in PARTS[method].items():
        names = [part, *(f"{part}.{sensor}" for sensor in sensors)]
        name = next((name for name in names if name in sampled.samples), None)
        if name is not None:
            values = [scale * sample for sample in sampled.samples[name]]
            correlation = _correlation(correlations, name)
            found[kind] = StatedCost(values, autocorrelation=correlation, source=f"{what}: [samples] {name}")
    if not found:
        raise InputError(
            f"{what} has samples of {', '.join(sampled.samples)}, of which none is a kind of job of {method}"
        )
    return found


def _correlation(table: Any, part: str) -> float | None:
    """Of a part, "correct.gps", from a table with a number for each, of a sensor's under its own name or nested."""
    kind, _, sensor = part.partition(".")
    for keys in ((part,), (kind, sensor)):
        found: Any = table
        for key in keys:
            found = found.get(key) if isinstance(found, Mapping) else None
        if isinstance(found, int | Decimal) and not isinstance(found, bool):
            return float(found)
    return None
