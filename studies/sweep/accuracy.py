"""The accuracy of a sweep's designs at the output, each at the step in which its corrections land."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

from filters.accuracy.designs import lossless_designs
from filters.accuracy.model import LinearModel
from filters.accuracy.predictor import px4_predictor
from filters.arrays import FloatArray
from filters.delayed.low_rate_noise import LowRateNoise
from sched_sim.errors import InputError, option
from studies.selection.conditions import TAU_S
from studies.selection.curve import by_landing
from studies.selection.methods import METHODS
from studies.selection.model import load_model, shipped_defaults
from studies.selection.outputs import outputs_of


class Stds(NamedTuple):
    """Standard deviations of the outputs, in their unit; None where nothing lands or the method has no such figure."""

    worst: float | None
    rms: float | None


NONE = Stds(None, None)


@dataclass(frozen=True, eq=False)
class OutputAccuracy:
    """Of which model, at which outputs. name, output: as they were asked for. pull: as in `selection.methods.Asked`,
    None where the rate of the HR loop is not known."""

    name: str
    output: str
    linear: LinearModel
    rows: FloatArray
    pull: float | None = None

    def description(self) -> dict[str, Any]:
        """All that its figures depend on."""
        matrices = {name: getattr(self.linear, name).tolist() for name in ("Phi", "Q", "H", "R")}
        return {"model": self.name, "output": self.output, "rows": self.rows.tolist(), "pull": self.pull, **matrices}

    def lacks(self, method: str) -> str:
        """Why the method has no figures here; empty if it has."""
        if method not in METHODS:
            return "its accuracy is not that of a late measurement"
        if method == "px4-predictor" and self.pull is None:
            return f"its time constant is in seconds: give {option('hr_hz')}"
        if METHODS[method].lossless or method == "px4-predictor":
            return ""
        return (
            f"its error is how far the measured quantities move: `sched-sim accuracy --method {method} --motion` has it"
        )

    def of(self, method: str, noise: LowRateNoise, N: Sequence[int], landed: Sequence[int | None]) -> list[Stds]:
        """Of designs that land so many steps after their measurement. Raises InputError for an N that a mode of the
        model goes unseen at."""
        if self.lacks(method):
            return [NONE] * len(N)
        lands = [at for at, L in enumerate(landed) if L is not None]
        if not lands:
            return [NONE] * len(N)
        periods, steps = np.array([N[at] for at in lands]), np.array([landed[at] for at in lands])
        try:
            if method == "px4-predictor":
                worst, rms = self._predicted(periods, steps)
            elif noise == "exact" or method != "dual-rate":
                worst, rms = lossless_designs(self.linear, self.rows, periods, steps)
            else:
                worst, rms = self._approximate(noise, periods, steps)
        except ValueError as error:
            raise InputError(f"{option('model')} {self.name}: {error}") from None
        found = [NONE] * len(N)
        for place, at in enumerate(lands):
            found[at] = Stds(_finite(worst[place]), _finite(rms[place]))
        return found

    def _predicted(self, N: Any, L: Any) -> tuple[FloatArray, FloatArray]:
        """Of PX4's output predictor; each N and L is computed once."""
        assert self.pull is not None
        designs, which = np.unique(np.stack([N, L], axis=1), axis=0, return_inverse=True)
        found = [px4_predictor(self.linear, self.rows, int(n), int(l), self.pull) for n, l in designs]
        figures = np.array([(of.worst, of.rms) for of in found])[which.ravel()]
        return figures[:, 0], figures[:, 1]

    def _approximate(self, noise: LowRateNoise, N: Any, L: Any) -> tuple[FloatArray, FloatArray]:
        worst, rms = np.empty(len(N)), np.empty(len(N))
        for period in np.unique(N):
            some = period == N
            most = int(L[some].max())
            worst[some] = by_landing(self.linear, self.rows, int(period), most, noise, "worst").figures[L[some]]
            rms[some] = by_landing(self.linear, self.rows, int(period), most, noise, "rms").figures[L[some]]
        return worst, rms


def _finite(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def output_accuracy(model: str | None, output: str | None, rates: Sequence[Fraction]) -> OutputAccuracy | None:
    """None if no model was named. rates: of the HR loop, if any were given.

    Raises InputError for outputs without a model, and for a shipped model at several rates.
    """
    if model is None:
        if output is not None:
            raise InputError(f"{option('output')} {output} without {option('model')}: give the model that has it")
        return None
    shipped = shipped_defaults(model)
    if shipped is not None and len(rates) > 1:
        raise InputError(
            f"{option('model')} {model} with several {option('hr_hz')}: it is another at each rate; sweep one at a time"
        )
    rate = rates[0] if len(rates) == 1 else None
    loaded = load_model(model, rate)
    outputs = outputs_of(loaded, output)
    hz = shipped.hr_hz if rate is None and shipped is not None else rate
    pull = None if hz is None else 1 / (float(hz) * TAU_S)
    return OutputAccuracy(model, output or outputs.name, loaded.linear, outputs.rows, pull)
