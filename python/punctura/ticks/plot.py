"""Plots Ticks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from punctura.ticks.fields import FIELDS, Array, Columns, membrane_count

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot(ticks: Columns, names: Sequence[str], x: str | None, axes: Axes | None) -> Axes:
    """See Ticks.plot."""
    x = x or ("time" if "time" in ticks else "depth")
    for name in (x, "axial_force", "lower", "upper"):
        if name not in ticks:
            raise KeyError(f"the plot needs the field {name}; these ticks have {', '.join(ticks)}")
    axes = _new_axes() if axes is None else axes
    along = ticks[x]
    if along.ndim > (2 if x in FIELDS and FIELDS[x].per_membrane else 1):
        raise ValueError(f"x = {x!r} is a vector; x must be a scalar field, such as 'time' or 'depth'")
    for i in range(membrane_count(ticks)):
        at = _of(along, i)
        name = names[i] if i < len(names) else f"membrane {i}"
        (line,) = axes.plot(at, _of(ticks["axial_force"], i), lw=1, label=name)
        for edge in (ticks["lower"], ticks["upper"]):
            axes.plot(at, _of(edge, i), lw=0.6, ls=":", color=line.get_color())
    axes.set_xlabel(_label(x))
    axes.set_ylabel("force along the needle (N), dotted: band")
    if membrane_count(ticks) > 1:
        axes.legend()
    return axes


def _of(values: Array, membrane: int) -> Array:
    column: Array = values[:, membrane] if values.ndim == 2 else values
    return column.astype(np.float64)


def _label(name: str) -> str:
    unit = FIELDS[name].unit if name in FIELDS else ""  # others, such as the lost ticks of a recording, have none
    return f"{name.replace('_', ' ')} ({unit})" if unit else name.replace("_", " ")


def _new_axes() -> Axes:
    from matplotlib.figure import Figure

    return Figure(layout="constrained").add_subplot()
