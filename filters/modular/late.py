"""The ways to use measurements that arrive late, by name, and the one door to them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal, TypeAlias

from filters.arrays import FloatArray
from filters.kernels.backends import BackendName
from filters.modular import dual_rate, larsen, recalculate
from filters.modular.composition import ModularFilter
from filters.modular.history import ModularHistory
from filters.modular.measurements import Measurement
from filters.problem import check_choice

Late: TypeAlias = Literal["recalculate", "larsen", "dual-rate"]


def run(
    composed: ModularFilter,
    x0: FloatArray,
    P0: FloatArray,
    inputs: FloatArray,
    measurements: Iterable[Measurement],
    *,
    late: Late = "recalculate",
    history: int | None = None,
    L: int | None = None,
    backend: BackendName = "reference",
) -> ModularHistory:
    """Filter a record of data in which measurements arrive in their steps or late.

    x0 (numbers,), P0 (n, n): estimate and covariance at step 0, before its measurements.
    inputs (steps, any): row j takes the state from j to j + 1; np.zeros((steps, 0)) if there are none.
    late: what is done with a late measurement: "recalculate" goes back, with any parts, any delays and in any order;
        "larsen" carries its correction forward, with linear and extended parts, one at a time; "dual-rate" corrects
        in a later step, with one sensor, linear or extended.
    history: of "recalculate", see there. L: of "dual-rate", see there.
    backend: "compiled" takes ten seconds or more the first time and is then some hundred times as fast as "reference".

    Raises:
        ValueError: a shape is wrong, P0 is not positive definite, a function does not do what it should (see `trial`),
            a measurement does not fit (see `measurements.arrivals`), the way cannot do with the filter or a
            measurement, or an estimate breaks down; the predictor or sensor is named.
    """
    check_choice("late", late, ("recalculate", "larsen", "dual-rate"))
    if history is not None and late != "recalculate":
        raise ValueError(
            f"history={history} goes with late='recalculate'; late={late!r} goes back no step, leave it out"
        )
    if L is not None and late != "dual-rate":
        raise ValueError(f"L={L} goes with late='dual-rate'; late={late!r} corrects on arrival, leave it out")
    if late == "larsen":
        return larsen.run(composed, x0, P0, inputs, measurements, backend=backend)
    if late == "dual-rate":
        return dual_rate.run(composed, x0, P0, inputs, measurements, L=L, backend=backend)
    return recalculate.run(composed, x0, P0, inputs, measurements, history=history, backend=backend)
