"""The methods that are written step by step, and which steps each can have."""

from __future__ import annotations

from collections.abc import Mapping

from filters.system import System
from filters.systems.coarse import over
from sched_sim.errors import InputError, option
from studies.board.serial.at_once import FUSE_AS_FRESH, STANDARD
from studies.board.serial.augmentation import AUGMENTATION
from studies.board.serial.carried_gain import CARRIED_GAIN, CARRIED_GAIN_IN_FLIGHT
from studies.board.serial.cloning import CLONE, CLONE_IN_FLIGHT, CLONE_SPLIT
from studies.board.serial.horizon import DELAYED_HORIZON, PX4_PREDICTOR
from studies.board.serial.larsen import LARSEN, LARSEN_IN_FLIGHT
from studies.board.serial.method import Serial
from studies.board.serial.multirate import MULTIRATE
from studies.board.serial.recalculate import RECALCULATE
from studies.board.steps import Steps

SERIAL: Mapping[str, Serial] = {
    "standard": STANDARD,
    "recalculate": RECALCULATE,
    "larsen": LARSEN,
    "clone": CLONE,
    "clone-split": CLONE_SPLIT,
    "carried-gain": CARRIED_GAIN,
    "delayed-horizon": DELAYED_HORIZON,
    "px4-predictor": PX4_PREDICTOR,
    "augmentation": AUGMENTATION,
    "fuse-as-fresh": FUSE_AS_FRESH,
    **MULTIRATE,
}
IN_FLIGHT: Mapping[str, Serial] = {
    "recalculate": RECALCULATE,
    "larsen": LARSEN_IN_FLIGHT,
    "clone": CLONE_IN_FLIGHT,
    "carried-gain": CARRIED_GAIN_IN_FLIGHT,
}
"""With M > N, where several measurements are on their way at once."""


def serial(method: str, steps: Steps) -> Serial:
    """How it is written."""
    return (IN_FLIGHT if steps.M > steps.N else SERIAL)[method]


def check_serial(method: str, steps: Steps) -> None:
    """Raises InputError unless the method can have these steps as C."""
    N, M, L = steps
    if method == "standard":
        return
    if method in MULTIRATE:
        if not 0 <= L <= N:
            raise InputError(f"{option('L')} {L} must be from 0 to {N}: a gain is in use before the next is computed")
        return
    if method == "delayed-horizon":
        if not 0 <= M < N:
            raise InputError(
                f"{option('M')} {M} must be from 0 to {N - 1}: delayed-horizon has one measurement on its way at a time"
            )
        if not M < L <= N:
            raise InputError(
                f"{option('L')} {L} must be from {M + 1} to {N}: what is replayed lands behind the arrival, "
                f"{option('M')} {M}, and before the next measurement is taken, {option('N')} {N}"
            )
        return
    if M < 1:
        raise InputError(f"{option('M')} {M} must be at least 1: without delay choose {option('method')} standard")
    if M > N and method not in IN_FLIGHT:
        raise InputError(
            f"{option('M')} {M} must be from 1 to {N}: {method} has one measurement on its way at a time; with several "
            f"choose {option('method')} {', '.join(IN_FLIGHT)}"
        )


def check_model(method: str, system: System, steps: Steps) -> None:
    """Raises InputError unless the model over N steps is known, where the method needs it."""
    if method in MULTIRATE:
        try:
            over(system, steps.N)
        except ValueError:
            raise InputError(
                f"{option('N')} {steps.N} with {option('method')} {method}: a model over {steps.N} steps is known only "
                f"of a linear_system whose Phi and Q do not change; give such a one by {option('system')}, or "
                f"{option('N')} 1, or leave it out for the jobs alone"
            ) from None
