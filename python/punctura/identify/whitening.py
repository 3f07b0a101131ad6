"""Correlated noise made white, so that least squares find the most likely parameters also beside slow noise."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from punctura.identify.noise import Mixture

Array = NDArray[np.float64]


class Whitening:
    """A linear map W that makes the noise of a mixture white: of each sample it leaves what those before do not tell.

    With an AR(1) noise, D makes the slow part white, so V = w 1 + a (D^T D)^-1, and W = C^-1 D with the Cholesky factor
    C of w D D^T + a 1. D and C have one diagonal beside the main one: O(n).
    """

    def __init__(self, mixture: Mixture, samples: int) -> None:
        from scipy.linalg import cholesky_banded

        rho = float(np.exp(-1 / mixture.length))
        scale = float(np.sqrt(-np.expm1(-2 / mixture.length)))  # of what is new in a sample of the slow noise
        self.mixture = mixture
        self._new = np.concatenate(([1.0], np.full(samples - 1, 1 / scale)))  # D: its main diagonal,
        self._old = np.full(samples - 1, -rho / scale)  # and the one below
        white = 1 - mixture.share
        main = self._new**2 + np.concatenate(([0.0], self._old**2))
        below = np.concatenate((self._new[:-1] * self._old, [0.0]))
        self._factor = cholesky_banded(np.vstack((mixture.share + white * main, white * below)), lower=True)
        self._size = float(self._factor[0, -1] * scale)  # then W has 1 at the end of its diagonal

    def __call__(self, columns: Array) -> Array:
        """W columns."""
        changes = self._new[:, None] * columns
        changes[1:] += self._old[:, None] * columns[:-1]
        return self._size * self._solved(changes, "N")

    def back(self, columns: Array) -> Array:
        """W^T columns."""
        solved = self._solved(columns, "T")
        given = self._new[:, None] * solved
        given[:-1] += self._old[:, None] * solved[1:]
        return self._size * given

    def _solved(self, columns: Array, trans: str) -> Array:
        from scipy.linalg.lapack import dtbtrs

        if not columns.size:  # dtbtrs writes beyond its memory
            return columns
        return np.asarray(dtbtrs(self._factor, columns, uplo="L", trans=trans)[0])
