"""The parts of a figure: picture, data, text, and numbers measured from the run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.figure import Figure
from numpy.typing import NDArray

from punctura.reproduce.words import Words

Table = Mapping[str, Sequence[Any] | NDArray[Any]]
"""Columns by name, with the unit in the name. All have the same length."""


@dataclass(frozen=True)
class Measured:
    """A number measured in a run, and the expected number from the law (NaN if the law gives none)."""

    figure: str
    quantity: str
    unit: str
    expected: float
    measured: float
    source: str  # source of the expected number


@dataclass(frozen=True)
class Drawing:
    """One figure. `tables` hold exactly the drawn data and are written as CSV files."""

    name: str  # name of its files, without suffix
    words: Words
    figure: Figure
    tables: Mapping[str, Table]  # file name without suffix -> columns
    measured: tuple[Measured, ...] = ()
