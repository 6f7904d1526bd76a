"""The ways to use measurements that arrive late, by name, and the one door to them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import ArrayLike

from filters.backends.choose import BackendName
from filters.choice import check_choice
from filters.modular import carried_gain, dual_rate, larsen, recalculate
from filters.modular.arrivals import TooOld, in_order
from filters.modular.composition import ModularFilter, check_composed
from filters.modular.history import ModularHistory
from filters.modular.measurements import Measurement

Late: TypeAlias = Literal["recalculate", "larsen", "carried-gain", "dual-rate"]


def run(
    composed: ModularFilter,
    x0: ArrayLike,
    P0: ArrayLike,
    inputs: ArrayLike | None,
    measurements: Iterable[Measurement],
    *,
    late: Late = "recalculate",
    history: int | None = None,
    L: int | Mapping[str, int] | None = None,
    too_old: TooOld = "refuse",
    backend: BackendName = "reference",
) -> ModularHistory:
    """Filter a record of data in which measurements arrive in their steps or late.

    x0 (numbers,), P0 (n, n): estimate and covariance at step 0, before its measurements.
    inputs (steps, any): row j takes the state from j to j + 1. None: there are none, and as many steps as it takes for
        all measurements to arrive; for another number of steps give np.zeros((steps, 0)).
    measurements: None in place of a number that is lost, see `Measurement`. Several of one sensor and one step are all
        used. Those that arrive after the last step are left out; "carried-gain" takes them into account when they are
        taken, and of those that are lost altogether when that is known, see `carried_gain`.
    late: what is done with a late measurement: "recalculate" goes back, with any parts, any delays and in any order;
        "larsen" and "carried-gain" carry its correction forward, with linear and extended parts; "dual-rate" corrects
        in a later step, with linear and extended parts.
    history: of "recalculate", see there. L: of "dual-rate", see there.
    too_old: what is done with a measurement from before the history, or one that arrives too late for L: "refuse", or
        "drop" it and go on; it is then among the `dropped` of what is returned.
    backend: "compiled" takes ten seconds or more the first time and is then some hundred times as fast as "reference".

    Raises:
        ValueError: a shape is wrong, P0 is no covariance, a function does not do what it should (see `trial`),
            a measurement does not fit (see `arrivals.arrivals`), the way cannot do with the filter or a
            measurement, or an estimate breaks down; the predictor or sensor is named.
    """
    check_composed(composed)
    check_choice("late", late, get_args(Late))
    if history is not None and late != "recalculate":
        raise ValueError(
            f"history={history} goes with late='recalculate'; late={late!r} goes back no step, leave it out"
        )
    if L is not None and late != "dual-rate":
        raise ValueError(f"L={L} goes with late='dual-rate'; late={late!r} corrects on arrival, leave it out")
    if too_old != "refuse" and late in ("larsen", "carried-gain"):
        raise ValueError(f"too_old={too_old!r}: for late={late!r} no measurement is too old, leave it out")
    if inputs is None:
        measurements = in_order(measurements)
        inputs = np.zeros((max((int(each.arrives) for each in measurements), default=0), 0))
    if late == "larsen":
        return larsen.run(composed, x0, P0, inputs, measurements, backend=backend)
    if late == "carried-gain":
        return carried_gain.run(composed, x0, P0, inputs, measurements, backend=backend)
    if late == "dual-rate":
        return dual_rate.run(composed, x0, P0, inputs, measurements, L=L, too_old=too_old, backend=backend)
    return recalculate.run(composed, x0, P0, inputs, measurements, history=history, too_old=too_old, backend=backend)
