"""The same system over n steps at once: the model from which a gain is computed every n-th step."""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np

from filters.choice import check_choice
from filters.problem import check_system
from filters.system import System
from filters.systems.linear import LinearParameters, linear_system

CoarseNoise: TypeAlias = Literal["averaged", "sampled"]


def over(system: System, n: int, noise: CoarseNoise = "averaged") -> System:
    """The system over n of its steps; j and k still count the system's own steps. n = 1: the system itself.

    Phi^n and the sum of Phi^i Q (Phi^i)^T over i < n, exactly, so Phi and Q must not change; f is not of use. H and R
    may: those of step k serve for the n steps from k on.

    noise: what one measurement of the coarse system is. "averaged": the mean of n, with R / n; noise then has the same
        spectral density R dT at both rates, and only so does the patent's step from Eq. (4) to (1), by way of the gain
        per unit of time, hold. "sampled": one of the n, with R; K / n is then too small for a filter that needs many
        measurements, by the square root of n for the scalar one.

    Raises:
        ValueError: n is less than 1, noise is unknown, or for n > 1 the system is not linear or its Phi or Q change.
    """
    check_system("system", system)
    if not isinstance(n, int | np.integer) or n < 1:
        raise ValueError(
            f"n={n!r} must be a whole number, at least 1: it is the number of steps that the coarse model takes at once"
        )
    check_choice("noise", noise, ("averaged", "sampled"))
    if n == 1:
        return system
    matrices = system.parameters
    if not isinstance(matrices, LinearParameters) or len(matrices.Phi) > 1 or len(matrices.Q) > 1:
        raise ValueError(_refusal(n))
    Phi, Q = matrices.Phi[0], matrices.Q[0]
    Phi_n, Q_n = np.eye(system.states), np.zeros_like(Q)
    for _ in range(n):
        Phi_n, Q_n = Phi @ Phi_n, Phi @ Q_n @ Phi.T + Q
    R = matrices.R / n if noise == "averaged" else matrices.R
    coarse = linear_system(Phi_n, matrices.B, matrices.H, Q_n, R)
    if coarse._replace(parameters=None) != system._replace(parameters=None, structure=None):
        raise ValueError(_refusal(n))
    return coarse


def _refusal(n: int) -> str:
    return (
        f"the model over n={n} steps is not known: only for a linear_system whose Phi and Q do not change can it be "
        f"made from that of one step; give it as coarse=..., a System whose F and Q span {n} steps"
    )
