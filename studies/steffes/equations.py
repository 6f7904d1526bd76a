"""Eqs. (5) to (24) of Steffes (2014), and the line of the filters that runs each."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import filters
from filters.covariance_forms import textbook
from filters.delayed import high_rate, larsen, low_rate, low_rate_noise, standard, update

ROOT = Path(filters.__file__).parent.parent


class Equation(NamedTuple):
    """number: of the paper; maths: as HTML in Markdown, readable as it is; function: that runs it, None if none does;
    begins: how its line begins; note: what else is to be known."""

    number: int
    maths: str
    function: Callable[..., Any] | None
    begins: str = ""
    note: str = ""

    @property
    def line(self) -> str:
        """As it stands in the function, without its comment. Raises LookupError if it stands there no more."""
        if self.function is None:
            return ""
        for text in inspect.getsource(self.function).splitlines():
            if text.strip().startswith(self.begins):
                return text.partition("#")[0].strip()
        raise LookupError(f"Eq. ({self.number}): no line of {self.function.__name__} begins with {self.begins!r}")

    @property
    def file(self) -> str:
        """Of the function, from the root of the repository."""
        return (
            ""
            if self.function is None
            else Path(inspect.getsourcefile(self.function) or "").relative_to(ROOT).as_posix()
        )


def _sub(text: str) -> str:
    return f"<sub>{text}</sub>"


K, KM, KP = _sub("k"), _sub("k⁻"), _sub("k⁺")
LAST, OVER = _sub("j−1"), _sub("(k−N)→j")
TO_LAST, START = _sub("(k−N)→(j−1)"), _sub("(k−N)→(k−N+1)")
PRED, PREV = _sub("k−1"), _sub("(k−1)⁺")
TO_M, M_MINUS, M_PLUS = _sub("k→m"), _sub("m⁻"), _sub("m⁺")
FIRST, TO_K = _sub("k−N"), _sub("(k−N)→k")

EQUATIONS = (
    Equation(
        *(5, f"z{K} = y{K} − h(x̂{KM})", update.update_error, "subtract_vectors(y, correction.z"),
        "the paper writes its model, z = H δx + ν",
    ),
    Equation(6, f"x̂{KM} = Φ{PRED} x̂{PREV} + B{PRED} u{PRED}", standard.propagate, "system.f("),
    Equation(7, f"δx̂{KM} = Φ{PRED} δx̂{PREV}", None, note="zero after each reset, so nothing is to be done"),
    Equation(8, f"P{KM} = Φ{PRED} P{PREV} Φ{PRED}ᵀ + Q{PRED}", standard.propagate, "form.propagation("),
    Equation(
        9, f"K{K} = P{KM} H{K}ᵀ [H{K} P{KM} H{K}ᵀ + R{K}]⁻¹", textbook.gain, "matmul_narrow(work.PHt, work.S_inverse"
    ),
    Equation(
        *(10, f"δx̂{KP} = δx̂{KM} + K{K} [z{K} − H{K} δx̂{KM}]", update.update_error, "matvec(correction.K"),
        f"with δx̂{KM} = 0",
    ),
    Equation(11, f"P{KP} = [I − K{K} H{K}] P{KM}", textbook.covariance, "matmul(work.nn1, P"),
    Equation(12, f"x̂{KP} = x̂{KM} + δx̂{KP}, δx̂{KP} ← 0", standard.update, "add_vectors(before.x"),
    Equation(13, f"δx̂{_sub('j⁻')} = Φ{OVER} δx̂{_sub('(k−N)⁺')}", high_rate.hr_update, "form.error("),
    Equation(14, f"P{_sub('j⁻')} = Φ{OVER} P{_sub('(k−N)⁺')} Φ{OVER}ᵀ + Q{OVER}", low_rate.lr_propagate, "form.cycle("),
    Equation(15, f"Φ{START} ≡ Φ{FIRST}", high_rate.hr_restart, "return Transition("),
    Equation(16, f"Φ{OVER} = Φ{LAST} Φ{TO_LAST}", high_rate.hr_propagate, "form.accumulation("),
    Equation(17, f"Q{START} ≡ Q{FIRST}", high_rate.hr_restart, "return Transition("),
    Equation(18, f"Q{OVER} = Φ{LAST} Q{TO_LAST} Φ{LAST}ᵀ + Q{LAST}", high_rate.hr_propagate, "form.noise("),
    Equation(19, f"x̂{_sub('l⁺')} = x̂{_sub('l')} + δx̂{_sub('l⁻')}", high_rate.hr_update, "add_vectors(x, work.n1"),
    Equation(
        *(20, f"x̂{M_PLUS} = x̂{M_MINUS} + Φ{TO_M} K{K} [z{K} − H{K} δx̂{KM}]", larsen.extrapolated_update),
        "add_vectors(before.x",
    ),
    Equation(
        *(21, f"P{M_PLUS} = P{M_MINUS} − Φ{TO_M} K{K} H{K} P{KM} Φ{TO_M}ᵀ", textbook.delayed_covariance),
        "subtract(P_m",
    ),
    Equation(
        *(22, f"P{M_PLUS} = Φ{TO_M} [I − K{K} H{K}] P{KM} Φ{TO_M}ᵀ + Q{TO_M}", None),
        note="Eq. (21) is run; that both give the same is a test",
    ),
    Equation(
        *(
            23,
            f"Q′{TO_K} = Σ Q{_sub('i')}, i = k−N … k−1",
            low_rate_noise.hr_propagate_sum,
            "add(transition.Q, system.Q",
        ),
    ),
    Equation(
        *(24, f"Q″{TO_K} = Σ Q{_sub('i')} of the second half + Φ{TO_K} (Σ Q{_sub('i')} of the first half) Φ{TO_K}ᵀ"),
        *(low_rate_noise.lr_propagate_euler, "form.cycle("),
        note="the first sum is added to P before, which is the same",
    ),
)
