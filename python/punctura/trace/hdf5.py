"""Reads HDF5 files by h5py; a MAT file of version 7.3 is one."""

from pathlib import Path
from typing import Any

import numpy as np

from punctura.extras import optional
from punctura.trace.heading import with_unit
from punctura.trace.reading import Reading
from punctura.trace.structured import table_of
from punctura.trace.table import MOST_COLUMNS, Table, check_size, unreadable
from punctura.trace.trace import TraceError


def read_hdf5(path: Path, reading: Reading) -> Table:
    """The only group that holds a trace; else the longest vectors of all groups. Raises TraceError, OSError."""
    h5py = optional("h5py", "formats", f"{path}: an HDF5 file, or a MAT file of version 7.3,")
    try:
        with h5py.File(path) as file:
            check_size(path, _numbers(file), 1)
            held = _held(file)
    except TraceError:
        raise
    except Exception as error:  # h5py raises many types for a damaged file
        raise unreadable(path, "HDF5", error) from None
    return table_of(path, held, reading)


def _numbers(group: Any) -> int:
    """How many numbers the datasets of a group hold, before they are read: a compressed one can be small."""
    total = 0

    def count(_: str, item: Any) -> None:
        nonlocal total
        total += getattr(item, "size", 0) or 0

    group.visititems(count)
    return total


def _with_unit(name: str, item: Any) -> str:
    unit = item.attrs.get("units", item.attrs.get("unit", ""))
    return with_unit(name, unit.decode("utf-8", "replace") if isinstance(unit, bytes) else str(unit))


def _held(item: Any) -> Any:
    """A group as a dictionary, a dataset as an array; None for one without numbers."""
    if hasattr(item, "items"):
        # #refs# has what cells of MATLAB refer to, _i_table an index of PyTables.
        parts = {_with_unit(name, part): _held(part) for name, part in item.items() if name[0] not in "#_"}
        lists = [part for part in parts.values() if isinstance(part, list) and not isinstance(part[0], dict)]
        if lists and len(lists) == len(parts) and len(set(map(len, lists))) == 1:  # an array of structures
            return [dict(zip(parts, values, strict=True)) for values in zip(*lists, strict=True)]
        return parts
    if item.dtype.names:  # a table
        return {name: item[name] for name in item.dtype.names}
    if item.dtype.kind == "O" and 0 < item.size <= MOST_COLUMNS:
        references = np.ravel(item[()])
        return [_held(item.file[one]) for one in references] if hasattr(references[0], "typecode") else None
    of_matlab = item.attrs.get("MATLAB_class")
    if item.dtype.kind not in "iuf" or item.ndim not in (1, 2) or of_matlab == b"char":
        return None
    values = item[()]
    return np.squeeze(values if of_matlab is None else values.T)  # MATLAB stores columns as rows
