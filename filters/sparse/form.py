"""A covariance form for a structure: the functions of a dense form without what is zero, products with one, and the
second half of what is symmetric."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Any, cast

from filters.records import Estimate, Workspace
from filters.sparse.straight_line import Operand, Traced, traced
from filters.sparse.structure import ANY, ONE, ZERO, Structure, full, transition, transition_noise

if TYPE_CHECKING:
    from filters.covariance_forms.form import CovarianceForm


@cache
def sparse_form(form: CovarianceForm, structure: Structure) -> CovarianceForm:
    """Its functions take the same arguments and give the same numbers, for matrices of that structure and covariances
    that are symmetric, all finite. The entries that are zero or one are written, and not read.

    What has nothing to do with F, H, Q or R is that of the dense form.
    """
    n, p = len(structure.F), len(structure.H)
    Phi = Operand(structure.F)
    Phi_from_k = Operand(transition(structure.F))
    Q, R, H = Operand(structure.Q), Operand(structure.R), Operand(structure.H)
    Q_from_k = Operand(transition_noise(structure.F, structure.Q), symmetric=True)
    P = Operand(full(n, n), symmetric=True)
    square, tall, flat = (Operand(full(*shape)) for shape in ((n, n), (n, p), (p, p)))
    vector: Any = Operand(ANY * n)
    out, work = {"out": square}, {"work": scratch(n, p)}

    def straight(name: str, kernel: Any, arguments: Mapping[str, Any], *outputs: str) -> Any:
        return traced(kernel, arguments).function(f"sparse_{name}", outputs)

    covariance = traced(form.covariance, {"P": P, "H": H, "R": R, "K": tall, **out, **work})
    delayed = traced(
        form.delayed_covariance, {"Phi": Phi_from_k, "P": P, "H": H, "R": R, "K": tall, "P_m": P, **out, **work}
    )
    left_by_gain = _scratch_read(covariance) | _scratch_read(delayed) | {"work.S"}
    return form._replace(
        product=straight("product", form.product, {"Phi": Phi, "A": square, **out}, "out"),
        accumulation=straight("accumulation", form.accumulation, {"Phi": Phi, "Phi_from_k": Phi_from_k, **out}, "out"),
        propagation=straight("propagation", form.propagation, {"Phi": Phi, "P": P, "Q": Q, **out, **work}, "out"),
        noise=straight("noise", form.noise, {"Phi": Phi, "Q_from_k": Q_from_k, "Q": Q, **out, **work}, "out"),
        cycle=straight(
            "cycle", form.cycle, {"Phi_from_k": Phi_from_k, "P": P, "Q_from_k": Q_from_k, **out, **work}, "out"
        ),
        carry=straight("carry", form.carry, {"Phi": Phi, "W": tall, "out": tall}, "out"),
        error=straight(
            "error",
            form.error,
            {"Phi_from_k": Phi_from_k, "delta_x": vector, "out": vector},
            "out",
        ),
        expectation=straight("expectation", form.expectation, {"H": H, "W": tall, "out": flat}, "out"),
        gain=straight("gain", form.gain, {"P": P, "H": H, "R": R, "K": tall, **work}, "K", *sorted(left_by_gain)),
        covariance=covariance.function("sparse_covariance", ["out"]),
        delayed_covariance=delayed.function("sparse_delayed_covariance", ["out"]),
        cross=straight("cross", form.cross, {"P": P, "H": H, "W": tall, **work}, "W"),
        cross_update=straight(
            "cross_update",
            form.cross_update,
            {
                "before": Estimate(vector, cast(Any, P)),
                **{"W": tall, "S": flat, "factor": flat, "z": Operand(ANY * p)},
                "after": Estimate(vector, cast(Any, square)),
                **work,
            },
            "after.x",
            "after.P",
        ),
    )


def _scratch_read(kernel: Traced) -> set[str]:
    return {array for array in kernel.reads(["out"]) if array.startswith("work.")}


def scratch(n: int, p: int) -> Workspace:
    """The identity, and scratch."""
    nn, np, pn, pp = (Operand(full(*shape)) for shape in ((n, n), (n, p), (p, n), (p, p)))
    identity = Operand(tuple(ZERO * i + ONE + ZERO * (n - 1 - i) for i in range(n)))
    fields: dict[str, Any] = {
        "I": identity,
        **dict.fromkeys(("nn1", "nn2", "nn3"), nn),
        **dict.fromkeys(("PHt", "np1"), np),
        **dict.fromkeys(("HP", "pn1"), pn),
        **dict.fromkeys(("S", "S_inverse", "pp1"), pp),
        "n1": Operand(ANY * n),
        "p1": Operand(ANY * p),
    }
    return Workspace(**fields)
