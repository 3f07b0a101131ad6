"""Reads a table of numbers from a file of any kind that is known."""

from math import prod
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet

from punctura.extras import optional
from punctura.trace.bags import is_bag, read_bag
from punctura.trace.clock import join_stamp
from punctura.trace.hdf5 import read_hdf5
from punctura.trace.packed import check_mat, holds_workbook
from punctura.trace.reading import Reading
from punctura.trace.structured import read_json, table_of
from punctura.trace.table import MOST_COLUMNS, Table, check_bytes, check_names, check_size, unreadable
from punctura.trace.tdms import read_tdms
from punctura.trace.text import read_text
from punctura.trace.trace import TraceError
from punctura.trace.workbook import read_workbook

_KINDS = {b"\xd0\xcf\x11\xe0": ".xls", b"\x89HDF": ".h5", b"PK\3\4": ".xlsx"}  # the first bytes


def read_table(path: Path, reading: Reading) -> Table:
    """All columns of a file, or of the sheet of it that is the trace. Raises TraceError, OSError."""
    check_bytes(path)
    if is_bag(path):
        return read_bag(path)
    suffix = _suffix(path)
    if suffix in (".xlsx", ".xlsm", ".xls"):
        table = read_workbook(path, reading, old=suffix == ".xls")
    elif suffix in (".h5", ".hdf5"):
        table = read_hdf5(path, reading)
    elif suffix in (".parquet", ".mat"):
        table = _parquet(path) if suffix == ".parquet" else _mat(path, reading)
    elif suffix == ".tdms":
        table = read_tdms(path, reading)
    elif suffix in (".json", ".jsonl", ".ndjson"):
        table = read_json(path, reading)
    else:
        table = read_text(path, reading.decimal, reading.encoding)
    if not table or not len(next(iter(table.values()))):
        raise TraceError(f"{path}: holds no rows of numbers")
    check_names(path, table)
    join_stamp(table)
    return table


def _suffix(path: Path) -> str:
    """The ending of a file's name; that of its kind where its first bytes show it, as programs also name XLSX .xls."""
    with path.open("rb") as file:
        head = file.read(8)
    kind = next((kind for start, kind in _KINDS.items() if head.startswith(start)), "")
    if kind == ".xlsx" and not holds_workbook(path):
        kind = ""
    ending = path.suffix.lower()
    of_text = ending == ".xls" and bool(head) and not head.lstrip(b"\xef\xbb\xbf \r\n\t").startswith(b"<")
    return kind or (".txt" if of_text else ending)  # a table with tabs is often named so


def _parquet(path: Path) -> Table:
    try:
        with pyarrow.parquet.ParquetFile(path) as file:
            schema, rows = file.schema_arrow, file.metadata.num_rows
            names = [field.name for field in schema if _is_number(field.type)]
            check_size(path, 0, len(schema))
            check_size(path, rows, len(names))
            check_names(path, schema.names)
            if len(set(schema.names)) < len(schema):
                raise TraceError(f"{path}: two columns have the same name; rename one")
            read = {name: file.read([name], use_threads=False)[name].cast(pa.float64()).to_numpy() for name in names}
            return Table(read)
    except (pa.ArrowException, OSError) as error:
        raise unreadable(path, "Parquet", error) from None


def _is_number(kind: pa.DataType) -> bool:
    return bool(pa.types.is_integer(kind) or pa.types.is_floating(kind))


def _mat(path: Path, reading: Reading) -> Table:
    optional("scipy.io", "identify", f"{path}: a MAT file")
    from scipy.io import loadmat, whosmat

    try:
        check_mat(path, structures=False)
        variables = whosmat(path)
        wanted = [
            name
            for name, shape, kind in variables
            if kind != "cell" and (kind != "struct" or prod(shape) <= MOST_COLUMNS)
        ]
        check_mat(path, structures=any(kind == "struct" for name, _, kind in variables if name in wanted))
        check_size(path, 0, len(variables))
        check_size(
            path, sum(prod(shape) for _, shape, kind in variables if kind not in ("cell", "struct", "sparse")), 1
        )
        held = loadmat(path, squeeze_me=True, simplify_cells=True, variable_names=wanted)
    except TraceError:
        raise
    except NotImplementedError:
        return read_hdf5(path, reading)  # of version 7.3
    except Exception as error:  # scipy raises many types for a damaged file
        raise unreadable(path, "MAT", error) from None
    return table_of(path, {name: value for name, value in held.items() if not name.startswith("__")}, reading)
