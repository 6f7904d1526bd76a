"""The cost table: what each job of each method costs. A small TOML file; filters write it, schedules read it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from pathlib import Path
from typing import Any, Literal, get_args

from sched_sim.errors import InputError
from sched_sim.options import Options
from sched_sim.ticks import positive

DelayedMethod = Literal["standard", "recalculate", "larsen", "dual-rate"]
MultirateMethod = Literal["multirate", "multirate-square-root", "multirate-ud"]
RobustMethod = Literal["robust-inverse", "robust-givens", "robust-lu", "robust-closed"]
Method = Literal[DelayedMethod, MultirateMethod, RobustMethod]
DELAYED_METHODS: tuple[DelayedMethod, ...] = get_args(DelayedMethod)
"""One measurement every N steps, that comes M steps late; and the standard filter, for which it is never late."""
MULTIRATE_METHODS: tuple[MultirateMethod, ...] = get_args(MultirateMethod)
"""A measurement in every step, covariance and gain every N-th ("Optimal covariance filtering", a patent, Eq. 1)."""
ROBUST_METHODS: tuple[RobustMethod, ...] = get_args(RobustMethod)
"""Inertial propagation in every step, and once in N steps the extended robust filter, whose linear system is solved in
one of four ways (Yengera, Inoue, Narasimha, Terra, arXiv:1801.04386)."""
SYSTEM_METHODS: tuple[Method, ...] = (*DELAYED_METHODS, *MULTIRATE_METHODS)
"""Those that run on any system model."""
TWO_RATE_METHODS: tuple[Method, ...] = (*MULTIRATE_METHODS, *ROBUST_METHODS)
"""An HR job in every step, an LR job once in N steps, whose result is in use by step l; no delayed measurement."""
METHODS: tuple[Method, ...] = (*DELAYED_METHODS, *TWO_RATE_METHODS)

Statistic = Literal["minimum", "median", "p95"]

KINDS: Mapping[str, tuple[str, ...]] = {
    "standard": ("propagate", "update"),
    "recalculate": ("propagate", "update", "replay"),
    "larsen": ("propagate", "propagate_accumulate", "update"),
    "dual-rate": (
        "hr_propagate",
        "hr_propagate_sum",
        "hr_propagate_euler",
        "hr_restart",
        "hr_update",
        "lr_propagate",
        "lr_propagate_euler",
        "lr_update",
        "lr_gain",
        "lr_correct",
    ),
    **dict.fromkeys(MULTIRATE_METHODS, ("state_update", "covariance_gain")),
    **dict.fromkeys(ROBUST_METHODS, ("inertial", "robust_step")),
}
"""Every entry a table may hold, by method. Those a run needs depend on its options: see `select`."""

ARITHMETIC = ("multiply", "add", "divide", "sqrt", "function")
"""Kinds of floating-point operation. A subtraction is an add; a function is sin, cos, exp and the like."""
OPERATION_KINDS = (*ARITHMETIC, "logic")
"""logic: what the arithmetic needs around it: loads, stores, index arithmetic, comparisons, branches."""

SECONDS: Mapping[str, Fraction] = {
    **dict.fromkeys(("second", "seconds", "s"), Fraction(1)),
    "ms": Fraction(1, 10**3),
    "us": Fraction(1, 10**6),
    "ns": Fraction(1, 10**9),
}
"""The units of costs that are times."""

Counts = Mapping[str, int]
"""How often one job does each kind of operation."""

SHIPPED = Path(__file__).parent / "cost_tables"
PAPERS, COUNTED = "steffes2014", "counted-9-3-3"
"""The tables that are meant if the user names none: of the paper; with a processor, counted operations."""


@dataclass(frozen=True, slots=True)
class Cost:
    """The work of one job, in the unit of its table. A cost written as one number has all three alike."""

    minimum: Fraction
    median: Fraction
    p95: Fraction

    @classmethod
    def of(cls, value: Fraction) -> Cost:
        return cls(value, value, value)

    def __truediv__(self, unit: Fraction) -> Cost:
        return Cost(self.minimum / unit, self.median / unit, self.p95 / unit)


@dataclass(frozen=True)
class CostTable:
    """Costs by method and job kind, all in one `unit` ("standard step", "seconds", "operations").

    `provenance` holds whatever else the file says of where they come from: source, update form, machine,
    versions, protocol, date. `path` is where it was read from, for messages. `operations` holds the counts of
    operations by method and job kind, where they are known; `processor.on_processor` turns them into time. `lacking`
    says of jobs that cannot have a cost why not.
    """

    name: str
    unit: str
    costs: Mapping[str, Mapping[str, Cost]]
    provenance: Mapping[str, Any] = field(default_factory=dict)
    path: str = ""
    operations: Mapping[str, Mapping[str, Counts]] = field(default_factory=dict)
    lacking: Mapping[str, Mapping[str, str]] = field(default_factory=dict)

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
    def processor(self) -> str | None:
        """The name of the one that the times are for; None if the file does not say."""
        about = self.provenance.get("processor")
        name = about.get("name") if isinstance(about, Mapping) else about
        return None if name is None else str(name)

    def _remedy(self, method: str, kind: str) -> str:
        if {self.name, self.path} & set(shipped_names()):
            others = [name for name in shipped_names() if kind in load(name).costs.get(method, {})]
            return f"use --costs {' or '.join([*others, 'a table that `sched-sim measure` writes'])}"
        return (
            f"add the line `{kind} = ...` there, choose a --method or option that does not need it, or measure it "
            f"with `sched-sim measure`"
        )

    def normalised(self) -> CostTable:
        """The same costs with the standard filter's propagate + update as the unit, as Steffes prints them."""
        step = self.entry("standard", "propagate").minimum + self.entry("standard", "update").minimum
        costs = {method: {kind: cost / step for kind, cost in kinds.items()} for method, kinds in self.costs.items()}
        return replace(self, unit="standard step", costs=costs)


@dataclass(frozen=True, slots=True)
class StandardCosts:
    """Work of the standard filter's pieces, which is not delayed: the update is due at k itself."""

    propagate: Any
    update: Any


@dataclass(frozen=True, slots=True)
class RecalculateCosts:
    """Work of the pieces of recalculate; update: the fixed part at m, replay: each re-propagated step."""

    propagate: Any
    update: Any
    replay: Any


@dataclass(frozen=True, slots=True)
class LarsenCosts:
    """Work of the pieces of Larsen's method; accumulate: a propagated step with the product Phi(k->j) in it."""

    propagate: Any
    accumulate: Any
    update: Any


@dataclass(frozen=True, slots=True)
class DualRateCosts:
    """Work of the dual-rate filter's pieces.

    hr: the HR job of an ordinary step; hr_restart: that of step k+1; hr_update: Eqs (13), (19);
    lr_propagate: Eq. (14); lr_gain: the part of the update done before the measurement arrives, 0 if none;
    lr_update: what is left to do after it arrived.
    """

    hr: Any
    hr_restart: Any
    hr_update: Any
    lr_propagate: Any
    lr_gain: Any
    lr_update: Any


@dataclass(frozen=True, slots=True)
class MultirateCosts:
    """Work of the pieces of the multirate gain; state_update: the HR job of each step, with a measurement in it;
    covariance_gain: the LR job, once in N steps."""

    state_update: Any
    covariance_gain: Any


@dataclass(frozen=True, slots=True)
class RobustCosts:
    """Work of the pieces of the robust filter at two rates; inertial: the HR job of each step; robust_step: the LR job,
    once in N steps, from step k, at which there is a measurement."""

    inertial: Any
    robust_step: Any


TwoRateCosts = MultirateCosts | RobustCosts
JobCosts = StandardCosts | RecalculateCosts | LarsenCosts | DualRateCosts | TwoRateCosts
"""What one method's pieces cost: fractions of the table's unit, or whole ticks; one number type throughout."""


def select(table: CostTable, method: str, options: Options, statistic: Statistic = "minimum") -> JobCosts:
    """The costs that `method` runs with under `options`, as fractions of the table's unit.

    Raises InputError for an unknown method and for an entry that the table lacks.
    """

    def cost(kind: str) -> Fraction:
        value: Fraction = getattr(table.entry(method, kind), statistic)
        return value

    if method == "standard":
        return StandardCosts(cost("propagate"), cost("update"))
    if method == "recalculate":
        return RecalculateCosts(cost("propagate"), cost("update"), cost("replay"))
    if method == "larsen":
        return LarsenCosts(cost("propagate"), cost("propagate_accumulate"), cost("update"))
    if method == "dual-rate":
        noise = "" if options.low_rate_noise == "exact" else f"_{options.low_rate_noise}"
        early = options.gain == "precomputed"
        return DualRateCosts(
            hr=cost(f"hr_propagate{noise}"),
            hr_restart=cost("hr_restart"),
            hr_update=cost("hr_update"),
            lr_propagate=cost("lr_propagate_euler" if noise == "_euler" else "lr_propagate"),
            lr_gain=cost("lr_gain") if early else Fraction(0),
            lr_update=cost("lr_correct" if early else "lr_update"),
        )
    if method in MULTIRATE_METHODS:
        return MultirateCosts(cost("state_update"), cost("covariance_gain"))
    if method in ROBUST_METHODS:
        return RobustCosts(cost("inertial"), cost("robust_step"))
    raise InputError(f"method {method!r} is unknown: choose from {', '.join(METHODS)}")


def arithmetic(counts: Counts) -> int:
    """Floating-point operations in `counts`, each counted once whatever its kind; logic is none."""
    return sum(number for kind, number in counts.items() if kind in ARITHMETIC)


def default_methods(*tables: CostTable) -> tuple[str, ...]:
    """What is meant if no method is named: those for a delayed measurement that every table has, or else all it has; of
    tables in which no job has a cost, those whose jobs are lacking one."""
    common = [method for method in METHODS if all(method in (table.costs or table.lacking) for table in tables)]
    return tuple(method for method in common if method in DELAYED_METHODS) or tuple(common)


def shipped_names() -> list[str]:
    """The names of the cost tables that come with the project."""
    return sorted(path.stem for path in SHIPPED.glob("*.toml"))


def load(name_or_path: str | Path) -> CostTable:
    """A shipped table by its name, or a user's own by its path.

    Raises InputError that names the file, every wrong entry in it, and the remedy.
    """
    from sched_sim.cost_file import read_cost_table

    text = str(name_or_path)
    path = SHIPPED / f"{text}.toml" if text in shipped_names() else Path(text)
    return read_cost_table(path, shown=text)


def positive_cost(value: Any, where: str) -> Fraction:
    """`value` as an exact cost; raises InputError that names `where` unless it is a number above 0."""
    if isinstance(value, bool | list | dict):
        shown = "no number" if isinstance(value, list | dict) else repr(value)
        raise InputError(f"{where} is {shown}: a cost is a number greater than 0")
    return positive(value, where)
