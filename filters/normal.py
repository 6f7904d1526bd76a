"""Normal random numbers, the same on every processor but for last digits."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.definite import covariance_root


def normal(random: np.random.Generator, covariance: FloatArray) -> FloatArray:
    """A draw (n,) from N(0, covariance (n, n)), which may be singular.

    By Cholesky's factor, which is one whatever the processor; eigenvectors have signs of LAPACK's choice, and where
    eigenvalues are equal their directions too.
    """
    return np.asarray(_root(covariance) @ random.standard_normal(len(covariance)))


def _root(covariance: FloatArray) -> FloatArray:
    try:
        return np.asarray(np.linalg.cholesky(covariance))
    except np.linalg.LinAlgError:
        root = np.zeros(covariance.shape)
        with np.errstate(all="ignore"):
            covariance_root(covariance, root)
        return root
