"""How the dual rate filter gets the process noise of N steps: exactly, or by the approximations of Sec. III.D."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np

from filters.arrays import FloatArray
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.high_rate import hr_propagate
from filters.delayed.low_rate import lr_propagate
from filters.kernels.dense import add
from filters.records import Transition, Workspace, new_transition
from filters.system import System

LowRateNoise: TypeAlias = Literal["exact", "sum", "euler"]


class HalvedTransition(NamedTuple):
    """Phi_{k->j} (n, n), and the sums of Q_i over the steps before and from `halfway` on, Eq. (24)."""

    Phi: FloatArray
    Q_first: FloatArray
    Q_second: FloatArray
    halfway: int


class NoiseMethod(NamedTuple):
    """What differs between the ways; a transition is whatever the method carries from step to step.

    propagate: the HR job of steps k + 2 .. k + N. lr_propagate: the LR job.
    start(transition, k, N): the transition of step k + 1, from Phi_k and Q_k.
    new(system): memory for a transition.
    """

    propagate: Callable[..., Any]
    lr_propagate: Callable[..., None]
    start: Callable[[Transition, int, int], Any]
    new: Callable[[System], Any]


def hr_propagate_sum(
    system: System,
    form: CovarianceForm,
    j: int,
    x: FloatArray,
    transition: Transition,
    u: FloatArray,
    x_next: FloatArray,
    following: Transition,
    _work: Workspace,
) -> Transition:
    """Job in place of `hr_propagate`: Q_{k->j} is only summed, Eq. (23), which saves two n x n x n products."""
    system.f(j, x, u, system.parameters, x_next)  # (6)
    form.accumulation(system.F(j, x, u, system.parameters), transition.Phi, following.Phi)  # (16)
    add(transition.Q, system.Q(j, system.parameters), following.Q)  # (23)
    return following


def hr_propagate_euler(
    system: System,
    form: CovarianceForm,
    j: int,
    x: FloatArray,
    transition: HalvedTransition,
    u: FloatArray,
    x_next: FloatArray,
    following: HalvedTransition,
    _work: Workspace,
) -> HalvedTransition:
    """Job in place of `hr_propagate`: one of the two sums of Eq. (24) grows, the other is handed on as it is."""
    system.f(j, x, u, system.parameters, x_next)  # (6)
    form.accumulation(system.F(j, x, u, system.parameters), transition.Phi, following.Phi)  # (16)
    Q = system.Q(j, system.parameters)
    if j < transition.halfway:
        add(transition.Q_first, Q, following.Q_first)
        return HalvedTransition(following.Phi, following.Q_first, transition.Q_second, transition.halfway)
    add(transition.Q_second, Q, following.Q_second)
    return HalvedTransition(following.Phi, transition.Q_first, following.Q_second, transition.halfway)


def lr_propagate_euler(
    form: CovarianceForm, P: FloatArray, transition: HalvedTransition, P_next: FloatArray, work: Workspace
) -> None:
    """Job in place of `lr_propagate`: P_{k^-} = Phi (P + Q_first) Phi^T + Q_second, which is Eq. (14) with Eq. (24)."""
    add(P, transition.Q_first, work.nn3)
    form.cycle(transition.Phi, work.nn3, transition.Q_second, P_next, work)


def _start_halved(transition: Transition, k: int, N: int) -> HalvedTransition:
    """The first half of an odd N is the shorter one, so that N = 1 is exact.

    Q_k is read at the end of the cycle, when the model may have filled its memory again.
    """
    halfway = k + N // 2
    nothing, Q = np.zeros_like(transition.Q), transition.Q.copy()
    if k < halfway:
        return HalvedTransition(transition.Phi, Q, nothing, halfway)
    return HalvedTransition(transition.Phi, nothing, Q, halfway)


def _new_halved(system: System) -> HalvedTransition:
    n = system.states
    return HalvedTransition(np.empty((n, n)), np.empty((n, n)), np.empty((n, n)), 0)


def _start(transition: Transition, _k: int, _N: int) -> Transition:
    return transition


NOISE_METHODS: dict[LowRateNoise, NoiseMethod] = {
    "exact": NoiseMethod(hr_propagate, lr_propagate, _start, new_transition),
    "sum": NoiseMethod(hr_propagate_sum, lr_propagate, _start, new_transition),
    "euler": NoiseMethod(hr_propagate_euler, lr_propagate_euler, _start_halved, _new_halved),
}
