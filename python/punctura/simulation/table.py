"""The columns of the result."""

from __future__ import annotations

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from punctura._core import InsertionTrace, Phase
from punctura.simulation.columns import output_columns

Floats = NDArray[np.float64]

PHASES = ["outside", "sticking", "sliding_in", "sliding_out", "barred"]  # by the value of Phase
assert all(getattr(Phase, name).value == i for i, name in enumerate(PHASES))

_PHASE = pa.dictionary(pa.int8(), pa.string())


def output_schema(has_axis: bool, membranes: int, metadata: dict[str, str]) -> pa.Schema:
    """Names and types of the output's columns."""
    names = output_columns(has_axis, membranes)
    fields = [pa.field(n, _PHASE if n.startswith("phase_") else pa.float64(), nullable=False) for n in names]
    return pa.schema(fields, metadata)


def output_table(
    schema: pa.Schema, time: Floats, position: Floats, axis: Floats | None, trace: InsertionTrace
) -> pa.Table:
    """One block of the result."""
    columns: list[Floats] = [time, *position.T]
    if axis is not None:
        columns += [*axis.T]
    columns += [*trace.force.T]
    arrays: list[pa.Array] = [pa.array(column) for column in columns]
    words = pa.array(PHASES)
    for i in range(trace.depth.shape[1]):
        each = (trace.depth, trace.axial_force, trace.lower, trace.upper)
        arrays += [pa.array(column[:, i]) for column in each]
        arrays.append(pa.DictionaryArray.from_arrays(pa.array(trace.phase[:, i].astype(np.int8)), words))
    return pa.Table.from_arrays(arrays, schema=schema)
