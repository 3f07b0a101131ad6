"""All combinations of values."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt


def grid(values: Mapping[str, npt.ArrayLike]) -> dict[str, npt.NDArray[np.float64]]:
    """All combinations of the values of each path, for `vary` of `punctura.batch`.

    values: by path, each (n,), SI. Returns by path (n1 n2 ..., ); the last path changes fastest.
    """
    axes = [np.atleast_1d(np.asarray(each, np.float64)) for each in values.values()]
    mesh = np.meshgrid(*axes, indexing="ij")
    return {path: np.ascontiguousarray(column.ravel()) for path, column in zip(values, mesh, strict=True)}
