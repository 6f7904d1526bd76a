"""Timings that others published, beside what the counts of the same job predict on the same part at the same clock."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np

from filters.backends.counted import Operations, count
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.factored import factored_form
from filters.factored.workspace import new_factored_workspace
from filters.kernels.dense import add_vectors, matmul, matmul_narrow, matmul_transposed_narrow, matvec
from filters.systems.linear import linear_system
from sched_sim.processors.part import at_clock, seconds_for
from sched_sim.processors.part_file import load_part
from studies.measurement.methods import nonzero


@dataclass(frozen=True)
class PublishedTiming:
    """A job's execution time on a part, as `source` at `url` has it.

    states, measurements, noises: sizes of the job; no measurements where it has none or they are not stated, the noises
    those of G in G Q G^T, 0 where Q is given as a matrix.
    job: one of `JOBS`. plain: whether the code is dense loops in C, as they are counted. code: what it is, in words.
    least_us, most_us: the time, microseconds.
    """

    source: str
    url: str
    part: str
    board: str
    clock_mhz: int
    states: int
    measurements: int
    noises: int
    job: str
    plain: bool
    code: str
    least_us: Fraction
    most_us: Fraction

    @property
    def predicted_us(self) -> Fraction:
        """What the part takes for the counted operations of the job, microseconds."""
        part = at_clock(load_part(self.part), Fraction(self.clock_mhz * 10**6))
        return 10**6 * seconds_for(nonzero(JOBS[self.job](self)), part, f"{self.source}, {self.job}")

    @property
    def ratios(self) -> tuple[Fraction, Fraction]:
        """Measured over predicted, least and most."""
        return self.least_us / self.predicted_us, self.most_us / self.predicted_us


@cache
def published_timings() -> tuple[PublishedTiming, ...]:
    """All of them, in the order of the file."""
    text = files("studies").joinpath("data/published-timings.toml").read_text(encoding="utf-8")
    return tuple(_timing(entry) for entry in tomllib.loads(text)["timing"])


def calibration(part: str) -> tuple[Fraction, Fraction] | None:
    """The least and the most measured over predicted of plain loops on the part of this name, if there are any."""
    ratios = [timing.ratios for timing in published_timings() if timing.part == part and timing.plain]
    return (min(least for least, _ in ratios), max(most for _, most in ratios)) if ratios else None


def _timing(entry: Mapping[str, Any]) -> PublishedTiming:
    time = entry["published_us"]
    least, most = map(Fraction, time if isinstance(time, list) else (time, time))
    others = {key: value for key, value in entry.items() if key != "published_us"}
    return PublishedTiming(**{"noises": 0} | others, least_us=least, most_us=most)


# ------------------------------------------------------------------------------------------ the jobs, counted


def _predict(sizes: PublishedTiming) -> Operations:
    """Phi x, and Phi P Phi^T + Q; Q = (G q) G^T if there are noises, of variances q."""
    n, r = sizes.states, sizes.noises
    Phi, square, G = np.eye(n), np.eye(n), np.ones((n, r))
    noise = count(matmul_transposed_narrow, G, G, square) + Operations(multiply=n * r) if r else Operations()
    covariance = count(covariance_form("textbook").propagation, Phi, square, square, square, _workspace(sizes).dense)
    return count(matvec, Phi, np.ones(n), np.ones(n)) + covariance + noise


def _update(form: CovarianceFormName) -> Callable[[PublishedTiming], Operations]:
    """K, P, and x + K z."""

    def update(sizes: PublishedTiming) -> Operations:
        P, H, R, K, work = *_arguments(sizes), _workspace(sizes).dense
        gain = count(covariance_form(form).gain, P, H, R, K, work)
        covariance = count(covariance_form(form).covariance, P, H, R, K, np.eye(sizes.states), work)
        return gain + covariance + _correction(sizes)

    return update


def _ud_predict(sizes: PublishedTiming) -> Operations:
    """Phi x, and U and D of Phi U D U^T Phi^T + Q, Q given as a matrix."""
    n = sizes.states
    Phi, factors = np.eye(n), np.eye(n)
    covariance = count(factored_form("u-d").propagation, Phi, factors, np.eye(n), np.eye(n), _workspace(sizes))
    return count(matvec, Phi, np.ones(n), np.ones(n)) + covariance


def _ud_update(sizes: PublishedTiming) -> Operations:
    """K, U and D, and x + K z."""
    P, H, R, K = _arguments(sizes)
    return count(factored_form("u-d").update, P, H, R, K, np.eye(sizes.states), _workspace(sizes)) + _correction(sizes)


def _whole_gain_first(sizes: PublishedTiming) -> Operations:
    """[I - K H] P, K H formed first."""
    P, H, R, K = _arguments(sizes)
    return count(covariance_form("textbook").covariance, P, H, R, K, np.eye(sizes.states), _workspace(sizes).dense)


def _thin_product_first(sizes: PublishedTiming) -> Operations:
    """H P, and P - K (H P)."""
    P, H, R, K = _arguments(sizes)
    thin = count(matmul, H, P, np.ones(H.shape))
    return thin + count(covariance_form("short").covariance, P, H, R, K, np.eye(sizes.states), _workspace(sizes).dense)


def _step(sizes: PublishedTiming) -> Operations:
    """Predict and update in the textbook form; what the model takes is not known, so it is not in it."""
    return _predict(sizes) + _update("textbook")(sizes)


def _matrix_product(sizes: PublishedTiming) -> Operations:
    """A B of square matrices."""
    square = np.eye(sizes.states)
    return count(matmul_narrow, square, square, square)


def _dot_product(sizes: PublishedTiming) -> Operations:
    """a^T b."""
    return count(matvec, np.ones((1, sizes.states)), np.ones(sizes.states), np.ones(1))


def _correction(sizes: PublishedTiming) -> Operations:
    x, z = np.ones(sizes.states), np.ones(sizes.measurements)
    return count(matvec, np.ones((sizes.states, sizes.measurements)), z, x) + count(add_vectors, x, x, x)


def _arguments(sizes: PublishedTiming) -> tuple[Any, Any, Any, Any]:
    """P, H, R, K."""
    n, p = sizes.states, sizes.measurements
    return np.eye(n), np.ones((p, n)), np.eye(p), np.ones((n, p))


def _workspace(sizes: PublishedTiming) -> Any:
    n, p = sizes.states, max(sizes.measurements, 1)
    system = linear_system(np.eye(n), np.zeros((n, 0)), np.ones((p, n)), np.eye(n), np.eye(p))
    return new_factored_workspace(system)


JOBS: Mapping[str, Callable[[PublishedTiming], Operations]] = {
    "predict": _predict,
    "update, short": _update("short"),
    "U-D predict": _ud_predict,
    "U-D update": _ud_update,
    "(K H) P": _whole_gain_first,
    "K (H P)": _thin_product_first,
    "step": _step,
    "matrix product": _matrix_product,
    "dot product": _dot_product,
}
"""What is counted for each job."""


# ------------------------------------------------------------------------------------------ the table of the page


def markdown() -> Sequence[str]:
    """The lines of the table in docs/explanation/published.md."""
    heading = ["source", "part", "states, measurements", "job", "code", "published, µs", "predicted, µs", "ratio"]
    rows = [_row(timing) for timing in published_timings()]
    return [f"| {' | '.join(row)} |" for row in (heading, ["---"] * 5 + ["---:"] * 3, *rows)]


def _row(timing: PublishedTiming) -> list[str]:
    sizes = f"{timing.states}, {timing.measurements}" if timing.measurements else str(timing.states)
    return [
        f"[{timing.source}]({timing.url})",
        f"`{timing.part}` at {timing.clock_mhz} MHz ({timing.board})",
        sizes,
        timing.job,
        timing.code,
        _range([_three_digits(us) for us in (timing.least_us, timing.most_us)]),
        _three_digits(timing.predicted_us),
        _range([f"{float(ratio):.2f}" for ratio in timing.ratios]),
    ]


def _three_digits(us: Fraction) -> str:
    return f"{float(us):.3g}" if us < 1000 else f"{round(us)}"


def _range(ends: Sequence[str]) -> str:
    return " to ".join(dict.fromkeys(ends))
