"""From continuous time to steps."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray


def discretised(A: FloatArray, density: FloatArray, period_s: float) -> tuple[FloatArray, FloatArray]:
    """Phi (n, n) and Q (n, n) over a period of dx/dt = A x + w, w white noise of this spectral density (n, n).

    One matrix exponential gives both: C. F. Van Loan, Computing integrals involving the matrix exponential, IEEE
    Transactions on Automatic Control 23, 1978. Raises ValueError for a period that is not positive.
    """
    from scipy.linalg import expm

    if not 0.0 < period_s < np.inf:
        raise ValueError(f"period_s={period_s!r} must be a positive number of seconds")
    n = len(A)
    both = np.zeros((2 * n, 2 * n))
    both[:n, :n], both[:n, n:], both[n:, n:] = -A, density, A.T
    exponential = expm(both * period_s)
    Phi = exponential[n:, n:].T
    Q = Phi @ exponential[:n, n:]
    return np.ascontiguousarray(Phi), 0.5 * (Q + Q.T)
