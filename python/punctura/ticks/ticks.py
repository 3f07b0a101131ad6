"""The class Ticks."""

from __future__ import annotations

import os
from collections.abc import ItemsView, Iterator, KeysView, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np
import numpy.typing as npt

from punctura._core import Fault, TickArrays, describe
from punctura.ticks.columns import Array, membrane_count
from punctura.ticks.fields import FIELDS

if TYPE_CHECKING:
    import pandas
    import polars
    import pyarrow
    from matplotlib.axes import Axes


class Ticks(TickArrays):
    """n ticks as arrays, one row a tick, SI units: `ticks.force` or `ticks["force"]`, `ticks[100:200]`.

    Which fields there are depends on what gave the ticks; docs/tick.md lists all. Vectors are (n, 3); the fields of
    each membrane (n, m), their vectors (n, m, 3). The ticks of a single proxy have no axis for membranes, and those of
    a proxy on a line none for components. A membrane that a tick did not have: NaN, and phase 255. The arrays are not
    copied.
    """

    def __init__(self, columns: Mapping[str, npt.ArrayLike], membranes: Sequence[str] = ()) -> None:
        """membranes: their names, for plots. Raises ValueError where the columns are of different lengths."""
        arrays = {
            name: np.asarray(column, dtype=FIELDS[name].dtype if name in FIELDS else None)
            for name, column in columns.items()
        }
        lengths = {name: len(array) for name, array in arrays.items()}
        if len(set(lengths.values())) > 1:
            listed = ", ".join(f"{name} {length}" for name, length in lengths.items())
            raise ValueError(f"all columns must have one row a tick, and have these lengths: {listed}")
        super().__init__(arrays)
        self.membranes = tuple(membranes)

    def __len__(self) -> int:
        return next((len(column) for column in self.columns.values()), 0)

    @overload
    def __getitem__(self, which: str) -> Array: ...
    @overload
    def __getitem__(self, which: slice | npt.NDArray[np.bool_] | npt.NDArray[np.integer[Any]]) -> Ticks: ...
    def __getitem__(self, which: Any) -> Any:
        """A column by its name; or some of the ticks, by a slice, a mask or their places."""
        if isinstance(which, str):
            if which not in self.columns:
                raise KeyError(f"{which}; these ticks have {', '.join(self.columns)}")
            return self.columns[which]
        if isinstance(which, (int, np.integer)):
            raise TypeError(f"one tick is a slice of length 1: ticks[{which}:{int(which) + 1}]")
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

    def get(self, name: str, otherwise: Array | None = None) -> Array | None:
        """A column, or `otherwise` where these ticks do not have it."""
        return self.columns.get(name, otherwise)

    def replace(self, **columns: npt.ArrayLike) -> Ticks:
        """The same with some columns changed or added."""
        return Ticks({**self.columns, **columns}, self.membranes)

    def __repr__(self) -> str:
        n = len(self)
        return f"Ticks({n} tick{'s' * (n != 1)}: {', '.join(self.columns)})"

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        return Ticks, (dict(self.columns), self.membranes)

    @property
    def membrane_count(self) -> int:
        """m; 1 for the ticks of a single proxy."""
        return membrane_count(self)

    @property
    def fault_text(self) -> str:
        """The fault that is latched in the last tick, and what to do; empty for none."""
        code = int(self.fault[-1]) if len(self) else 0
        return describe(Fault(code)) if code else ""

    def to_arrow(self, words: bool = True) -> pyarrow.Table:
        """A table with the columns of a file: time_s, x_m, depth_0_m ... words: in place of codes, as "sticking"."""
        from punctura.ticks.arrow import to_arrow

        return to_arrow(self, words)

    def to_pandas(self) -> pandas.DataFrame:
        """The same as a DataFrame. Needs the package pandas."""
        return self.to_arrow().to_pandas()

    def to_polars(self) -> polars.DataFrame:
        """The same as a DataFrame of Polars. Needs the package polars."""
        import polars

        frame = polars.from_arrow(self.to_arrow())
        assert isinstance(frame, polars.DataFrame)
        return frame

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes .csv or .parquet; a file there is replaced once the new one is whole. Raises ValueError, OSError."""
        from punctura.ticks.files import save

        save(self.to_arrow(), path)

    def plot(self, x: str | None = None, axes: Axes | None = None) -> Axes:
        """Draws each membrane's force along the needle and its band against "time", "depth" or another field.

        x: time if these ticks have it, else depth. Gives the axes; `axes.figure.savefig` writes them.
        """
        from punctura.ticks.plot import plot

        return plot(self, self.membranes, x, axes)
