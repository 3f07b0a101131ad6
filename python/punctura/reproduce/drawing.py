"""What a figure is made of: the picture, its data, the words beside it, the numbers measured from it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.figure import Figure
from numpy.typing import NDArray

from punctura.reproduce.words import Words

Table = Mapping[str, Sequence[Any] | NDArray[Any]]
"""Columns by name, the unit in the name, all of one length."""


@dataclass(frozen=True)
class Measured:
    """A number read off a run, beside the one that the law gives; not a number where it gives none."""

    figure: str
    quantity: str
    unit: str
    expected: float
    measured: float
    source: str  # where the expected number comes from


@dataclass(frozen=True)
class Drawing:
    """One figure. `tables` are written as CSV files: what is drawn, and nothing else."""

    name: str  # of its files, without ending
    words: Words
    figure: Figure
    tables: Mapping[str, Table]  # file name without ending -> columns
    measured: tuple[Measured, ...] = ()
