"""What others timed, as calls of the functions here: to be counted, or run on an emulated core."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import FunctionType
from typing import Any, NamedTuple, cast

import numpy as np

from filters.arrays import FloatArray
from filters.backends.counted import Operations, count
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.factored import factored_form
from filters.factored.workspace import new_factored_workspace
from filters.kernels.dense import add_vectors, matmul, matmul_narrow, matmul_transposed_narrow, matvec
from filters.sparse.structure import Structure
from filters.systems.linear import linear_system


class Sizes(NamedTuple):
    """Of a job: no measurements where it has none, noises those of G in G Q G^T, 0 where Q is given as a matrix."""

    states: int
    measurements: int
    noises: int


class Call(NamedTuple):
    """function: a kernel. arguments: of the job's sizes, with numbers that no kernel refuses."""

    function: FunctionType
    arguments: tuple[Any, ...]


def counted(calls: Sequence[Call]) -> Operations:
    """The operations of all of them."""
    return sum((count(call.function, *call.arguments) for call in calls), start=Operations())


def _call(function: Callable[..., Any], *arguments: Any) -> Call:
    return Call(cast("FunctionType", function), arguments)


def _predict(sizes: Sizes) -> list[Call]:
    """Phi x, and Phi P Phi^T + Q; Q = (G q) G^T if there are noises, of variances q."""
    n, r = sizes.states, sizes.noises
    Phi, square, G = np.eye(n), np.eye(n), np.ones((n, r))
    noise = [_call(_scale_columns, G, np.ones(r), G), _call(matmul_transposed_narrow, G, G, square)] if r else []
    covariance = _call(covariance_form("textbook").propagation, Phi, square, square, square, _workspace(sizes).dense)
    return [_call(matvec, Phi, np.ones(n), np.ones(n)), covariance, *noise]


def _scale_columns(G: FloatArray, q: FloatArray, out: FloatArray) -> None:
    """G times the diagonal matrix of q."""
    for i in range(len(G)):
        for j in range(len(q)):
            out[i, j] = G[i, j] * q[j]


ERROR_STATE = Structure(
    F=(
        *("100*00000000000", "0100*0000000000", "00100*000000000"),
        *("000100******000", "000010******000", "000001******000"),
        *("000000***000*00", "000000***0000*0", "000000***00000*"),
        *("0" * i + "1" + "0" * (14 - i) for i in range(9, 15)),
    ),
    H=("1" + "0" * 14,),
    Q=tuple("0" * i + ("0" if i < 3 else "*") + "0" * (14 - i) for i in range(15)),
    R=("*",),
)
"""Of eskf-rs: errors of position, velocity, attitude, and the biases of accelerometers and gyros."""


def _sparse_predict(sizes: Sizes) -> list[Call]:
    """F P F^T + Q of `ERROR_STATE`, without its zeros. What the state takes, a quaternion and sums, is not in it."""
    square = np.ones((sizes.states, sizes.states))
    propagation = covariance_form("textbook", ERROR_STATE).propagation
    return [_call(propagation, square, square, square, square, _workspace(sizes).dense)]


def _update(form: CovarianceFormName) -> Callable[[Sizes], list[Call]]:
    """K, P, and x + K z."""

    def update(sizes: Sizes) -> list[Call]:
        P, H, R, K, work = *_arguments(sizes), _workspace(sizes).dense
        gain = _call(covariance_form(form).gain, P, H, R, K, work)
        covariance = _call(covariance_form(form).covariance, P, H, R, K, np.eye(sizes.states), work)
        return [gain, covariance, *_correction(sizes)]

    return update


def _ud_predict(sizes: Sizes) -> list[Call]:
    """Phi x, and U and D of Phi U D U^T Phi^T + Q, Q given as a matrix."""
    n = sizes.states
    Phi, factors = np.eye(n), np.eye(n)
    covariance = _call(factored_form("u-d").propagation, Phi, factors, np.eye(n), np.eye(n), _workspace(sizes))
    return [_call(matvec, Phi, np.ones(n), np.ones(n)), covariance]


def _ud_update(sizes: Sizes) -> list[Call]:
    """K, U and D, and x + K z."""
    P, H, R, K = _arguments(sizes)
    update = _call(factored_form("u-d").update, P, H, R, K, np.eye(sizes.states), _workspace(sizes))
    return [update, *_correction(sizes)]


def _whole_gain_first(sizes: Sizes) -> list[Call]:
    """[I - K H] P, K H formed first."""
    P, H, R, K = _arguments(sizes)
    return [_call(covariance_form("textbook").covariance, P, H, R, K, np.eye(sizes.states), _workspace(sizes).dense)]


def _thin_product_first(sizes: Sizes) -> list[Call]:
    """H P, and P - K (H P)."""
    P, H, R, K = _arguments(sizes)
    covariance = _call(covariance_form("short").covariance, P, H, R, K, np.eye(sizes.states), _workspace(sizes).dense)
    return [_call(matmul, H, P, np.ones(H.shape)), covariance]


def _step(sizes: Sizes) -> list[Call]:
    """Predict and update in the textbook form; what the model takes is not known, so it is not in it."""
    return [*_predict(sizes), *_update("textbook")(sizes)]


def _matrix_product(sizes: Sizes) -> list[Call]:
    """A B of square matrices."""
    square = np.eye(sizes.states)
    return [_call(matmul_narrow, square, square, square)]


def _dot_product(sizes: Sizes) -> list[Call]:
    """a^T b."""
    return [_call(matvec, np.ones((1, sizes.states)), np.ones(sizes.states), np.ones(1))]


def _correction(sizes: Sizes) -> list[Call]:
    x, z = np.ones(sizes.states), np.ones(sizes.measurements)
    return [_call(matvec, np.ones((sizes.states, sizes.measurements)), z, x), _call(add_vectors, x, x, x)]


def _arguments(sizes: Sizes) -> tuple[Any, Any, Any, Any]:
    """P, H, R, K."""
    n, p = sizes.states, sizes.measurements
    return np.eye(n), np.ones((p, n)), np.eye(p), np.ones((n, p))


def _workspace(sizes: Sizes) -> Any:
    n, p = sizes.states, max(sizes.measurements, 1)
    system = linear_system(np.eye(n), np.zeros((n, 0)), np.ones((p, n)), np.eye(n), np.eye(p))
    return new_factored_workspace(system)


JOBS: Mapping[str, Callable[[Sizes], Sequence[Call]]] = {
    "predict": _predict,
    "predict, sparse": _sparse_predict,
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
