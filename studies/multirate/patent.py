"""The patent's example ("Optimal covariance filtering"): its processor loads, and its operations term by term."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache
from importlib.resources import files
from typing import Any, Literal, NamedTuple, TypeAlias, get_args

import numpy as np

from filters.backends.counted import Operations, count
from filters.kernels import dense, solve
from filters.registry import MULTIRATE_METHODS
from filters.systems.gps import gps

Cycle: TypeAlias = Literal["state_update", "covariance_gain"]
CYCLES: tuple[Cycle, ...] = get_args(Cycle)

STATES, NOISES, MEASUREMENTS = 8, 4, 4
LIMIT_PERCENT = 5
"""What the filter may take of the processor, as the patent requires ("limited to 5 percent")."""


class Load(NamedTuple):
    """One of the three cases. percent: as the patent computes it, exactly; printed: as it prints it.

    complete_percent: with the state update, which the patent leaves out of the first two cases.
    """

    name: str
    percent: Fraction
    printed: str
    complete_percent: Fraction


class Term(NamedTuple):
    """A term of the filter's algebra, dense.

    ours: counted in the loops that the jobs are made of, where a dot product of length m takes m - 1 adds.
    from_zero: the same where a dot product starts from zero and takes m adds.
    in_job: the system model of `filters.systems.gps` holds Q as one matrix, so its products are not in our jobs.
    """

    cycle: Cycle
    name: str
    ours: Operations
    from_zero: Operations
    in_job: bool


class Observation(NamedTuple):
    """A statement about the printed counts, and whether it is true."""

    text: str
    holds: bool


class Comparison(NamedTuple):
    """A cycle as a whole. job: counted in the job itself, conventional form, textbook update.

    with_noise_model, from_zero: the sums of all terms, those not in the job included, by the two conventions.
    printed: the patent's figure. remainder: printed less from_zero.
    """

    cycle: Cycle
    job: Operations
    with_noise_model: Operations
    from_zero: Operations
    printed: Operations
    remainder: dict[str, int]


@cache
def _published() -> dict[str, Any]:
    return tomllib.loads(files("studies").joinpath("data/patent_multirate.toml").read_text(encoding="utf-8"))


def cycle_us(cycle: Cycle) -> int:
    """Execution time of a cycle from the printed operations, logic included, and the printed times, microseconds."""
    times: dict[str, int] = _published()["times_us"]
    operations: dict[str, int] = _published()[cycle]
    return sum(number * times[kind] for kind, number in operations.items())


def printed_cycle_us() -> int:
    """The execution time of a cycle that is printed, microseconds."""
    return int(_published()["printed"]["cycle_us"])


def loads() -> list[Load]:
    """The three cases in their order."""
    state_update, covariance_gain = (Fraction(cycle_us(cycle), 1_000_000) for cycle in CYCLES)
    rows = []
    for case in _published()["load"]:
        alone = covariance_gain / case["covariance_every_s"]
        complete = alone + state_update / case["state_update_every_s"]
        load = complete if case["state_update_counted"] else alone
        rows.append(Load(case["name"], 100 * load, case["percent"], 100 * complete))
    return rows


def printed_operations(cycle: Cycle) -> Operations:
    """The printed floating-point operations of a cycle."""
    return Operations(**{kind: number for kind, number in _published()[cycle].items() if kind != "logic"})


def terms() -> list[Term]:
    """All terms of both cycles, for 8 states, 4 noise sources and 4 measurements."""
    n, q, p = STATES, NOISES, MEASUREMENTS
    return [
        *_terms(
            "state_update",
            ("Phi x", _matvec(n, n)),
            ("H x", _matvec(p, n)),
            ("y - H x", _plain(dense.subtract_vectors, p)),
            ("K z", _matvec(n, p)),
            ("x + K z", _plain(dense.add_vectors, n)),
        ),
        *_terms(
            "covariance_gain",
            ("Phi P", _matmul(n, n, n)),
            ("(Phi P) Phi'", _matmul(n, n, n)),
            ("+ Q", _plain(dense.add, n, n)),
            ("Gamma q", _matmul(n, q, q)),
            ("(Gamma q) Gamma'", _matmul(n, q, n)),
            ("P H'", _matmul(n, n, p)),
            ("H P", _matmul(p, n, n)),
            ("(H P) H'", _matmul(p, n, p)),
            ("+ R", _plain(dense.add, p, p)),
            ("S^-1", count(solve.inverse, np.eye(p), _zeros(p, p), _zeros(p, p))),
            ("(P H') S^-1", _matmul(n, p, p)),
            ("K H", _matmul(n, p, n)),
            ("I - K H", _plain(dense.subtract, n, n)),
            ("(I - K H) P", _matmul(n, n, n)),
            ("K / n", Operations(multiply=n * p)),
            not_in_job=("Gamma q", "(Gamma q) Gamma'"),
        ),
    ]


def comparison(cycle: Cycle) -> Comparison:
    """A cycle as our job does it, as the sum of its terms, and as printed."""
    job = MULTIRATE_METHODS["multirate"].jobs(gps(steps=30), "textbook")[cycle]
    of_cycle = [term for term in terms() if term.cycle == cycle]
    with_noise_model = total([term.ours for term in of_cycle])
    from_zero = total([term.from_zero for term in of_cycle])
    printed = printed_operations(cycle)
    remainder = {kind: getattr(printed, kind) - getattr(from_zero, kind) for kind in ("multiply", "add", "divide")}
    return Comparison(cycle, count(job.function, *job.arguments(0)), with_noise_model, from_zero, printed, remainder)


def total(operations: Sequence[Operations]) -> Operations:
    """The sum, kind by kind."""
    return sum(operations, start=Operations())


def observations() -> list[Observation]:
    """What can be said of the printed counts, with n = 8, p = 4. None of it tells how they came about.

    A division into terms is not unique: with p = n / 2, n^3 = 2 n^2 p = 4 n p^2 = 8 p^3, and n p = 4 n.
    """
    n, p = STATES, MEASUREMENTS
    state, covariance = (printed_operations(cycle) for cycle in CYCLES)
    whole = state + covariance
    products = total([term.from_zero for term in terms() if term.name not in ("S^-1", "K / n")]).multiply
    return [
        Observation("all multiplies: 139 + 2965 = 6 n^3 + 4 n", whole.multiply == 6 * n**3 + 4 * n),
        Observation("all adds: 128 + 3488 = 7 n^3 + 4 n, n^3 more than multiplies", whole.add == 7 * n**3 + 4 * n),
        Observation(
            "adds of the state update: 128 = n^2 + 2 n p, those of Phi x, y - H x and x + K z where each sum starts "
            "from zero, y or x",
            state.add == n**2 + 2 * n * p,
        ),
        Observation(
            "multiplies of the state update: n^2 + 2 n p are in these products, 11 are not",
            state.multiply - (n**2 + 2 * n * p) == 11,
        ),
        Observation(
            "multiplies of both cycles: all products, with H P and P H' apart and Gamma q Gamma', take 6 n^3; 32 are "
            "left, which S^-1 (128 as we do it) does not fit into",
            products == 6 * n**3 and whole.multiply - products == 32,
        ),
        Observation(
            "divides: 36 = 4 (n + 1), as for four scalar updates with n + 1 each, but also n (n + 1) / 2",
            covariance.divide == 4 * (n + 1) == n * (n + 1) // 2,
        ),
    ]


def _terms(cycle: Cycle, *named: tuple[str, Operations], not_in_job: Sequence[str] = ()) -> list[Term]:
    return [Term(cycle, name, ours, _from_zero(name, ours), name not in not_in_job) for name, ours in named]


def _from_zero(name: str, ours: Operations) -> Operations:
    """A product then has as many adds as multiplies; a sum stays what it is, and so does the inverse."""
    is_product = ours.multiply > 0 and ours.add > 0 and name != "S^-1"
    return ours._replace(add=ours.multiply) if is_product else ours


def _matvec(rows: int, columns: int) -> Operations:
    return count(dense.matvec, _zeros(rows, columns), _zeros(columns), _zeros(rows))


def _matmul(rows: int, inner: int, columns: int) -> Operations:
    return count(dense.matmul, _zeros(rows, inner), _zeros(inner, columns), _zeros(rows, columns))


def _plain(kernel: Callable[..., None], *shape: int) -> Operations:
    return count(kernel, _zeros(*shape), _zeros(*shape), _zeros(*shape))


def _zeros(*shape: int) -> Any:
    return np.zeros(shape)
