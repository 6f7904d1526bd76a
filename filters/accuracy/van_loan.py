"""From continuous time to steps."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray

TERMS = 16
"""Of the series, which then leaves out less than rounding does."""


def discretised(A: FloatArray, density: FloatArray, period_s: float) -> tuple[FloatArray, FloatArray]:
    """Phi (n, n) and Q (n, n) over a period of dx/dt = A x + w, w white noise of this spectral density (n, n).

    One matrix exponential gives both: C. F. Van Loan, Computing integrals involving the matrix exponential, IEEE
    Transactions on Automatic Control 23, 1978. Raises ValueError for a period that is not positive.
    """
    if not 0.0 < period_s < np.inf:
        raise ValueError(f"period_s={period_s!r} must be a positive number of seconds")
    n = len(A)
    both = np.zeros((2 * n, 2 * n))
    both[:n, :n], both[:n, n:], both[n:, n:] = -A, density, A.T
    exponential = matrix_exponential(both * period_s)
    Phi = exponential[n:, n:].T
    Q = Phi @ exponential[:n, n:]
    return np.ascontiguousarray(Phi), 0.5 * (Q + Q.T)


def matrix_exponential(A: FloatArray) -> FloatArray:
    """e^A by its series at A / 2^s, of a norm of a quarter at most, and s squarings: to import scipy.linalg takes
    longer than all else."""
    norm = float(np.abs(A).sum(axis=0).max(initial=0.0))
    squarings = max(int(np.ceil(np.log2(norm))) + 2, 0) if norm > 0.0 else 0
    scaled = A / 2.0**squarings
    term = result = np.eye(len(A))
    for number in range(1, TERMS + 1):
        term = term @ scaled / number
        result = result + term
    for _ in range(squarings):
        result = result @ result
    return result
