"""All combinations of values."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from punctura._core import real_numbers
from punctura.batches.inputs import enough_memory


def grid(values: Mapping[str, npt.ArrayLike]) -> dict[str, npt.NDArray[np.float64]]:
    """All combinations of the values of each path, for `vary` of `punctura.batch`.

    values: by path, each (n,), SI. Returns by path (n1 n2 ..., ); the last path changes fastest. Raises
    TypeError, ValueError and MemoryError.
    """
    if isinstance(values, type) or not hasattr(values, "items"):
        raise TypeError(f"grid needs a dict of paths to lists of numbers, not {type(values).__name__}")
    given = dict(values.items())  # a pandas Series iterates over its values
    for path in given:
        if not isinstance(path, str):
            raise TypeError(f"grid: paths must be str, not {type(path).__name__}")
    axes = [np.atleast_1d(real_numbers(each, f"grid: {path}")) for path, each in given.items()]
    for path, each in zip(given, axes, strict=True):
        if each.ndim != 1:
            raise ValueError(f"grid: {path} has the shape {each.shape}; give a list of numbers")
    count = math.prod(len(each) for each in axes)
    enough_memory(
        16.0 * count * len(axes), f"{count} combinations", "Give fewer values, or draw them (punctura study)."
    )
    mesh = np.meshgrid(*axes, indexing="ij")
    return {path: np.ascontiguousarray(column.ravel()) for path, column in zip(given, mesh, strict=True)}
