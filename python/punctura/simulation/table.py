"""Converts the ticks of a simulation to the table of its result file."""

from __future__ import annotations

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from punctura.ticks import FIELDS, Ticks
from punctura.ticks.fields import shape_of

Floats = NDArray[np.float64]

WRITTEN = ("time", "position", "axis", "force", "depth", "axial_force", "lower", "upper", "phase")


def output_schema(has_axis: bool, membranes: int, metadata: dict[str, str]) -> pa.Schema:
    """Names and types of the output's columns."""
    names = [name for name in WRITTEN if has_axis or name != "axis"]
    none = Ticks({name: np.empty(shape_of(FIELDS[name], 0, membranes), FIELDS[name].dtype) for name in names})
    schema = none.to_arrow().schema
    return pa.schema([field.with_nullable(False) for field in schema], metadata)


def output_table(schema: pa.Schema, time: Floats, position: Floats, axis: Floats | None, ticks: Ticks) -> pa.Table:
    """One block of the result. position and axis are written unchanged."""
    given = {"time": time, "position": position} | ({} if axis is None else {"axis": axis})
    written = {name: given[name] if name in given else ticks[name] for name in WRITTEN if name != "axis"}
    table = Ticks(written | given).to_arrow()
    return pa.Table.from_arrays([column.combine_chunks() for column in table.select(schema.names)], schema=schema)
