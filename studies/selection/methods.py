"""How accurate each method is, by its name: where its corrections land is all that most of them differ in."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Literal, NamedTuple, TypeAlias

from filters.accuracy.approximate import discarded, with_low_rate_noise
from filters.accuracy.exact import lossless
from filters.accuracy.fresh import fused_as_fresh
from filters.accuracy.model import LinearModel
from filters.accuracy.outcome import Accuracy
from filters.accuracy.pattern import Interval
from filters.accuracy.predictor import px4_predictor
from filters.arrays import FloatArray
from filters.delayed.low_rate_noise import LowRateNoise

Landing: TypeAlias = Literal["at once", "at M", "later"]
"""In the step of the measurement itself, in that of its arrival, or in one after it, as fast as the processor is."""


class Asked(NamedTuple):
    """Of which filter: between, the steps from one measurement to the next, M, and L, where its corrections land.

    displacement (p,): by which the measured quantity moves during the delay; None if no motion was stated. pull: period
    of a step over the time constant of PX4's output predictor; None where the rate of the loop is not known.
    """

    model: LinearModel
    rows: FloatArray
    between: Interval
    M: int
    L: int
    low_rate_noise: LowRateNoise = "exact"
    displacement: FloatArray | None = None
    pull: float | None = None


class Method(NamedTuple):
    """accuracy: of an `Asked`. needs: what must have been said beside it. lossless: whether it is as good as the age of
    its measurements allows, and so known by that age; floored: never better than that, and known by a long sum."""

    landing: Landing
    accuracy: Callable[[Asked], Accuracy]
    needs: Literal["", "motion", "hr_hz"] = ""
    lossless: bool = True
    floored: bool = False


def _exact(asked: Asked) -> Accuracy:
    return lossless(asked.model, asked.rows, asked.between, asked.L)


def _dual_rate(asked: Asked) -> Accuracy:
    return with_low_rate_noise(asked.model, asked.rows, asked.between, asked.L, asked.low_rate_noise)


def _px4_predictor(asked: Asked) -> Accuracy:
    assert asked.pull is not None
    return px4_predictor(asked.model, asked.rows, asked.between, asked.L, asked.pull)


def _fuse_as_fresh(asked: Asked) -> Accuracy:
    assert asked.displacement is not None
    return fused_as_fresh(asked.model, asked.rows, asked.between, asked.M, asked.displacement)


def _discard(asked: Asked) -> Accuracy:
    return discarded(asked.model, asked.rows, asked.between)


METHODS: Mapping[str, Method] = {
    "standard": Method("at once", _exact),
    "recalculate": Method("at M", _exact),
    "larsen": Method("at M", _exact),
    "clone": Method("at M", _exact),
    "clone-split": Method("at M", _exact),
    "carried-gain": Method("at M", _exact),
    "augmentation": Method("at M", _exact),
    "dual-rate": Method("later", _dual_rate),
    "delayed-horizon": Method("later", _exact),
    "px4-predictor": Method("at M", _px4_predictor, "hr_hz", lossless=False, floored=True),
    "fuse-as-fresh": Method("at M", _fuse_as_fresh, "motion", lossless=False),
    "discard": Method("at M", _discard, lossless=False),
}

COMPARED = tuple(name for name in METHODS if name not in ("clone-split", "discard"))
"""If none is named."""


def by_reason(of_methods: Iterable[tuple[str, str]]) -> list[str]:
    """Each reason once, with the methods that it is of; without those of which there is none."""
    named: dict[str, list[str]] = {}
    for method, reason in dict.fromkeys(of_methods):
        if reason:
            named.setdefault(reason, []).append(method)
    return [f"{', '.join(methods)}: {reason}" for reason, methods in named.items()]
