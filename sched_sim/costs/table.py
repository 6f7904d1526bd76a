"""The cost table: what each job of each method costs. A small TOML file; filters write it, schedules read it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from sched_sim.costs.methods import DELAYED_METHODS, METHODS
from sched_sim.costs.operations import Counts
from sched_sim.errors import InputError, option
from sched_sim.ticks import positive

PAPERS, COUNTED = "steffes2014", "counted-9-3-3"
"""The tables that are meant if the user names none: of the paper; with a processor, counted operations."""

SECONDS: Mapping[str, Fraction] = {
    **dict.fromkeys(("second", "seconds", "s"), Fraction(1)),
    "ms": Fraction(1, 10**3),
    "us": Fraction(1, 10**6),
    "ns": Fraction(1, 10**9),
}
"""The units of costs that are times."""


INSTRUCTION = "instruction"
"""The unit of costs that were counted on an emulated core: no cycles, and so no times."""


PLURALS = {
    "standard step": "standard steps",
    "second": "seconds",
    "operation": "operations",
    "instruction": "instructions",
}


def units(unit: str) -> str:
    """The plural of a cost table's unit, where it is a word; "ms" stays."""
    return PLURALS.get(unit, unit)


def measured_on_busy_machine(provenance: Mapping[str, Any]) -> bool | None:
    """Whether something else had the machine while costs of this provenance were timed; None if `sched-sim measure`
    did not time them."""
    if provenance.get("busy"):
        return True
    return False if "protocol" in provenance else None


def busy_note(provenance: Mapping[str, Any]) -> str:
    """A line, if the machine was busy while the costs were timed; empty otherwise."""
    busy = provenance.get("busy")
    return f"measured on a busy machine: {busy}; measure again on an idle one" if busy else ""


@dataclass(frozen=True, slots=True)
class Cost:
    """The work of one job, in the unit of its table. A cost written as one number has all three alike."""

    minimum: Fraction
    median: Fraction
    p95: Fraction

    @classmethod
    def of(cls, value: Fraction) -> Cost:
        """A cost that is always so much."""
        return cls(value, value, value)

    def __truediv__(self, unit: Fraction) -> Cost:
        return Cost(self.minimum / unit, self.median / unit, self.p95 / unit)


def _nowhere(_method: str, _kind: str) -> None:
    """No table beside a user's own."""


@dataclass(frozen=True)
class CostTable:
    """Costs by method and job kind, all in one `unit` ("standard step", "seconds", "operations").

    `provenance` holds whatever else the file says of where they come from: source, update form, machine,
    versions, protocol, date. `path` is where it was read from, for messages. `operations` holds the counts of
    operations by method and job kind, where they are known; `part.on_part` turns them into time. `lacking`
    says of jobs that cannot have a cost why not. `found_in` names the tables beside it that have an entry; None if it
    is a user's own, to be completed.
    """

    name: str
    unit: str
    costs: Mapping[str, Mapping[str, Cost]]
    provenance: Mapping[str, Any] = field(default_factory=dict)
    path: str = ""
    operations: Mapping[str, Mapping[str, Counts]] = field(default_factory=dict)
    lacking: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    found_in: Callable[[str, str], Sequence[str] | None] = field(default=_nowhere, compare=False, repr=False)

    def __post_init__(self) -> None:
        """A number stands for a cost that is always so much."""
        costs = {
            method: {kind: _as_cost(cost, f"[costs.{method}] {kind}") for kind, cost in kinds.items()}
            for method, kinds in self.costs.items()
        }
        object.__setattr__(self, "costs", costs)

    def has(self, method: str, kind: str) -> bool:
        """Whether there is such an entry."""
        return kind in self.costs.get(method, {})

    def entry(self, method: str, kind: str) -> Cost:
        """Raises InputError that names the missing entry and how to supply it."""
        try:
            return self.costs[method][kind]
        except KeyError:
            if kind in self.lacking.get(method, {}):
                raise InputError(self.lacking[method][kind]) from None
            section = "operations" if self.operations else "costs"
            raise InputError(
                f"cost table {self.shown} has no entry [{section}.{method}] {kind}: {self._remedy(method, kind)}"
            ) from None

    @property
    def shown(self) -> str:
        """Name and path, for messages."""
        return f"{self.name} ({self.path})" if self.path else self.name

    @property
    def update_form(self) -> str | None:
        """The form of the covariance update that was costed, such as "textbook"; None if the file does not say."""
        form = self.provenance.get("update_form")
        return None if form is None else str(form)

    @property
    def structure(self) -> str | None:
        """ "sparse" if zeros and ones of the model were left out, "dense" if all was multiplied; None if the file does
        not say."""
        structure = self.provenance.get("structure", None if self.update_form is None else "dense")
        return None if structure is None else str(structure)

    @property
    def measured_on_busy_machine(self) -> bool | None:
        """See the function of this name."""
        return measured_on_busy_machine(self.provenance)

    @property
    def processor(self) -> str | None:
        """The name of the one that the times are for; None if the file does not say."""
        about = self.provenance.get("processor")
        name = about.get("name") if isinstance(about, Mapping) else about
        return None if name is None else str(name)

    @property
    def target(self) -> str | None:
        """The core on which instructions were counted; None for other costs."""
        target = self.provenance.get("target")
        return None if target is None else str(target)

    def memory_bytes(self, method: str) -> int:
        """RAM and stack of all tasks of a method. Raises InputError if the table does not say."""
        try:
            parts = self.provenance["memory"][method].values()
            return sum(int(part["ram"]) + int(part["stack"]) for part in parts)
        except (KeyError, TypeError, AttributeError, ValueError):
            raise InputError(
                f"cost table {self.shown} does not say what memory {method} needs: use {option('costs')} with a table "
                f"that `sched-sim measure --backend emulated` writes"
            ) from None

    def _remedy(self, method: str, kind: str) -> str:
        others = self.found_in(method, kind)
        if others is not None:
            return f"use {option('costs')} {' or '.join([*others, 'a table that `sched-sim measure` writes'])}"
        return (
            f"add the line `{kind} = ...` there, choose a {option('method')} or option that does not need it, or "
            f"measure it with `sched-sim measure`"
        )

    def _repr_html_(self) -> str:
        from sched_sim.html_table import html_table

        rows = [
            (method, kind, cost.minimum, cost.median, cost.p95)
            for method, kinds in self.costs.items()
            for kind, cost in kinds.items()
        ]
        return html_table(f"{self.shown}, in {self.unit}", ("method", "job", "minimum", "median", "p95"), rows)

    def normalised(self) -> CostTable:
        """The same costs with the standard filter's propagate + update as the unit, as Steffes prints them."""
        step = self.entry("standard", "propagate").minimum + self.entry("standard", "update").minimum
        costs = {method: {kind: cost / step for kind, cost in kinds.items()} for method, kinds in self.costs.items()}
        return replace(self, unit="standard step", costs=costs)


def default_methods(*tables: CostTable) -> tuple[str, ...]:
    """What is meant if no method is named: those for a delayed measurement that every table has, or else all it has; of
    tables in which no job has a cost, those whose jobs are lacking one."""
    common = [method for method in METHODS if all(method in (table.costs or table.lacking) for table in tables)]
    return tuple(method for method in common if method in DELAYED_METHODS) or tuple(common)


def _as_cost(value: Any, where: str) -> Cost:
    return value if isinstance(value, Cost) else Cost.of(positive_cost(value, where))


def positive_cost(value: Any, where: str) -> Fraction:
    """`value` as an exact cost; raises InputError that names `where` unless it is a number above 0."""
    if isinstance(value, bool | list | dict):
        shown = "no number" if isinstance(value, list | dict) else repr(value)
        raise InputError(f"{where} is {shown}: a cost is a number greater than 0")
    return positive(value, where)
