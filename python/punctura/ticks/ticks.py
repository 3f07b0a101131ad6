"""The class Ticks."""

from __future__ import annotations

import os
import sys
from collections.abc import ItemsView, Iterator, KeysView, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np
import numpy.typing as npt

from punctura._core import Fault, TickArrays, describe
from punctura.extras import optional
from punctura.ticks.fields import FIELDS, Array, membrane_count

if TYPE_CHECKING:
    import pandas
    import polars
    import pyarrow
    from matplotlib.axes import Axes


def _typed(name: str, column: npt.ArrayLike) -> Array:
    """The column with its field's type. Raises ValueError for a number that the type does not hold."""
    # NumPy imports numpy.ma at its first use. In a run, that keeps Python's lock from a thread that feeds a device.
    if "numpy.ma" in sys.modules and np.ma.is_masked(column):
        raise ValueError(f"{name} has masked elements: fill them in, or leave these ticks out")
    given = np.asarray(column)
    if given.ndim == 0:
        raise ValueError(f"{name} must be an array with one row per tick, not a single value")
    if name not in FIELDS:
        return given
    typed = given.astype(FIELDS[name].dtype, copy=False) if given.dtype.kind in "biuf" else None
    if typed is None or (typed is not given and typed.dtype.kind != "f" and not np.array_equal(typed, given)):
        raise ValueError(f"{name} must hold numbers of type {FIELDS[name].dtype}, and holds others")
    return typed


class Ticks(TickArrays):
    """n ticks as arrays, one row per tick, in SI units: `ticks.force` or `ticks["force"]`, `ticks[100:200]`.

    The fields depend on the source of the ticks; docs/tick.md lists all. Vectors are (n, 3). Fields per membrane are
    (n, m), their vectors (n, m, 3). Ticks of a single proxy have no membrane axis, and those of Proxy1d have no
    component axis. A membrane that a tick did not have is NaN, with phase 255. The arrays are not copied.
    """

    def __init__(self, columns: Mapping[str, npt.ArrayLike], membranes: Sequence[str] = ()) -> None:
        """membranes: their names, for plots. Raises TypeError, or ValueError for columns of unequal length."""
        if isinstance(columns, type) or not hasattr(columns, "items"):
            raise TypeError(f"columns must be a dict of column names to arrays, not {type(columns).__name__}")
        if unnamed := [name for name in columns if not isinstance(name, str)]:
            raise TypeError(f"the names of columns must be str, not {type(unnamed[0]).__name__}: {unnamed[0]!r}")
        arrays = {name: _typed(name, column) for name, column in columns.items()}
        lengths = {name: len(array) for name, array in arrays.items()}
        if len(set(lengths.values())) > 1:
            listed = ", ".join(f"{name} {length}" for name, length in lengths.items())
            raise ValueError(f"all columns must have the same length, one row per tick; their lengths are {listed}")
        if isinstance(membranes, str | bytes):
            raise TypeError(f"membranes must be a list of names, not {type(membranes).__name__}")
        super().__init__(arrays)
        self.membranes = tuple(membranes)

    def __len__(self) -> int:
        return next((len(column) for column in self.columns.values()), 0)

    @overload
    def __getitem__(self, which: str) -> Array: ...
    @overload
    def __getitem__(self, which: slice | npt.NDArray[np.bool_] | npt.NDArray[np.integer[Any]]) -> Ticks: ...
    def __getitem__(self, which: Any) -> Any:
        """A column by name, or a part of the ticks by slice, mask or indices."""
        if isinstance(which, str):
            if which not in self.columns:
                raise KeyError(f"no field {which}; these ticks have {', '.join(self.columns)}")
            return self.columns[which]
        if isinstance(which, (int, np.integer)):
            end = int(which) + 1 or ""  # ticks[-1:] is the last tick
            raise TypeError(f"a single index is not supported; use a slice: ticks[{which}:{end}]")
        return Ticks({name: column[which] for name, column in self.columns.items()}, self.membranes)

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def keys(self) -> KeysView[str]:
        """The names of the columns."""
        return self.columns.keys()

    def items(self) -> ItemsView[str, Array]:
        """The columns by name."""
        return self.columns.items()

    def get(self, name: str, default: Array | None = None) -> Array | None:
        """A column, or `default` if these ticks do not have it."""
        return self.columns.get(name, default)

    def replace(self, **columns: npt.ArrayLike) -> Ticks:
        """A copy with some columns replaced or added."""
        return Ticks({**self.columns, **columns}, self.membranes)

    def __repr__(self) -> str:
        n = len(self)
        return f"Ticks({n} tick{'s' * (n != 1)}: {', '.join(self.columns)})"

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        return Ticks, (dict(self.columns), self.membranes)

    @property
    def membrane_count(self) -> int:
        """Number of membranes m; 1 for the ticks of a single proxy."""
        return membrane_count(self)

    @property
    def fault_text(self) -> str:
        """The fault that is latched in the last tick, with its remedy; empty if none."""
        code = int(self.fault[-1]) if len(self) else 0
        return describe(Fault(code)) if code else ""

    def to_arrow(self, words: bool = True) -> pyarrow.Table:
        """An Arrow table with the columns of a file: time_s, x_m, depth_0_m ... words: write codes as words.

        Of columns that are not in docs/tick.md, only those with one value per tick are included.
        """
        optional("pyarrow", "files", "Ticks.to_arrow")
        from punctura.ticks.arrow import to_arrow

        return to_arrow(self, words)

    def to_pandas(self) -> pandas.DataFrame:
        """The same table as a pandas DataFrame. Needs the package pandas."""
        optional("pandas", "frames", "Ticks.to_pandas")
        return self.to_arrow().to_pandas()

    def to_polars(self) -> polars.DataFrame:
        """The same table as a Polars DataFrame. Needs the package polars."""
        frame: polars.DataFrame = optional("polars", "frames", "Ticks.to_polars").from_arrow(self.to_arrow())
        return frame

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes .csv or .parquet. An existing file is replaced by the complete new one. Raises ValueError, OSError."""
        optional("pyarrow", "files", "Ticks.save")
        from punctura.ticks.files import save

        save(self.to_arrow(), path)

    def plot(self, x: str | None = None, axes: Axes | None = None) -> Axes:
        """Plots each membrane's force along the needle and its band over "time", "depth" or another field.

        x: default "time" if these ticks have it, else "depth". Returns the axes; `axes.figure.savefig` saves the plot.
        """
        optional("matplotlib", "plots", "Ticks.plot")
        from punctura.ticks.plot import plot

        return plot(self, self.membranes, x, axes)
