"""The arguments of a batch: combinations of values, seeds, and whether there is room for the results."""

from __future__ import annotations

import math
import operator
import os
from collections.abc import Mapping
from pathlib import Path
from typing import SupportsIndex

import numpy as np
import numpy.typing as npt

from punctura._core import real_numbers


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


def whole_seeds(seeds: SupportsIndex | npt.ArrayLike, trials: int) -> npt.NDArray[np.uint64]:
    """The seed of each trial. Raises TypeError, ValueError if it is not a whole number from 0 to 2^64 - 1."""
    array = np.asarray(seeds)
    if array.ndim > 1:
        raise ValueError(f"seeds must be one number, or have shape ({trials},), not {array.shape}")
    if array.dtype.kind not in "iuO":  # a large int alone is an object
        raise TypeError(f"seeds must hold whole numbers, not {array.dtype}")
    for i, seed in enumerate(array.ravel()) if array.dtype.kind in "iO" else ():
        where = f"seeds[{i}]" if array.ndim else "seeds"
        try:
            number = operator.index(seed)
        except TypeError:
            raise TypeError(f"{where} must be a whole number, not {seed!r}") from None
        if not 0 <= number < 2**64:
            raise ValueError(f"{where} must be from 0 to 2^64 - 1, not {number}")
    if array.ndim:
        return np.ascontiguousarray(array, np.uint64)
    first = operator.index(array[()])
    if first + trials > 2**64:
        raise ValueError(f"seeds: {first} is too large to count up for {trials} trials; the last seed is 2^64 - 1")
    return np.uint64(first) + np.arange(trials, dtype=np.uint64)


def enough_memory(needed: float, what: str, advice: str) -> None:
    """Raises MemoryError if an object of so many bytes has no room on this computer. what: the object."""
    there = _free_memory()
    if there is not None and needed > there:
        raise MemoryError(f"{what} need {needed / 1e9:.3g} GB of memory, and {there / 1e9:.3g} GB are free. {advice}")


def _free_memory() -> float | None:
    """Bytes that a program can still take; without /proc, all bytes that there are. None if unknown."""
    try:
        lines = Path("/proc/meminfo").read_text().splitlines()
        return float(next(line.split()[1] for line in lines if line.startswith("MemAvailable:"))) * 1024
    except (OSError, StopIteration, ValueError, IndexError):
        pass
    try:
        return float(os.sysconf("SC_PHYS_PAGES")) * float(os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, ValueError, OSError):
        return None
