"""Writes result files, CSV and Parquet. A file gets its name only when it is complete."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Protocol

import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

from punctura.files.cells import csv_line, text_cell
from punctura.files.whole_file import whole_file

_ROWS_A_GROUP = 1 << 16


class Output(Protocol):
    """Writes a result block by block."""

    def write(self, table: pa.Table) -> None: ...


class CsvOutput:
    """Writes CSV. Numbers have as many digits as needed to read the same double again, 17 at most."""

    def __init__(self, file: Any, schema: pa.Schema) -> None:
        self._file = file
        file.write(csv_line(map(text_cell, schema.names)).encode())
        self._free = [i for i, field in enumerate(schema) if pa.types.is_string(field.type)]  # text of any kind
        quoting = "needed" if self._free else "none"  # the words of a dictionary are ours
        self._options = pyarrow.csv.WriteOptions(include_header=False, quoting_style=quoting)

    def write(self, table: pa.Table) -> None:
        for i in self._free:
            cells = [text and text_cell(text) for text in table.column(i).to_pylist()]
            table = table.set_column(i, table.field(i), pa.array(cells, pa.string()))
        pyarrow.csv.write_csv(table, self._file, self._options)


class ParquetOutput:
    """Collects tables or batches into row groups."""

    def __init__(self, writer: pyarrow.parquet.ParquetWriter, schema: pa.Schema, rows_a_group: int) -> None:
        self._writer, self._schema, self._most = writer, schema, rows_a_group
        self._tables: list[pa.Table] = []
        self._rows = 0

    def write(self, rows: pa.Table | pa.RecordBatch) -> None:
        table = pa.Table.from_batches([rows]) if isinstance(rows, pa.RecordBatch) else rows
        self._tables.append(table.replace_schema_metadata(self._schema.metadata))
        self._rows += len(table)
        if self._rows >= self._most:
            self.flush()

    def flush(self) -> None:
        if self._rows:
            self._writer.write_table(pa.concat_tables(self._tables), row_group_size=self._rows)
        self._tables, self._rows = [], 0


@contextmanager
def parquet_output_to(where: Any, schema: pa.Schema, rows_a_group: int, **options: Any) -> Iterator[ParquetOutput]:
    """Writes Parquet to a path or an open file. options: of pyarrow's ParquetWriter.

    Only words have a dictionary. One of numbers that hardly repeat would take two thirds of the time, save nothing,
    and merge different NaNs; so numbers keep their bits.
    """
    words = [field.name for field in schema if isinstance(field.type, pa.DictionaryType)]
    with pyarrow.parquet.ParquetWriter(where, schema, use_dictionary=words, **options) as writer:
        output = ParquetOutput(writer, schema, rows_a_group)
        yield output
        output.flush()


SUFFIXES = (".csv", ".parquet")


def save(table: pa.Table, path: str | os.PathLike[str], private: bool = False) -> None:
    """See Ticks.save. private: see whole_file."""
    target = Path(path)
    if target.suffix.lower() not in SUFFIXES:
        raise ValueError(f"{target} must end in {' or '.join(SUFFIXES)}")
    with open_output(target, table.schema, private) as output:
        output.write(table)


@contextmanager
def open_output(path: Path, schema: pa.Schema, private: bool = False) -> Iterator[Output]:
    """Opens a result file. It gets its name when it is complete; an error leaves no file."""
    with whole_file(path, private=private) as place:
        if path.suffix.lower() == ".parquet":
            with parquet_output_to(place, schema, _ROWS_A_GROUP) as output:
                yield output
        else:
            with pa.OSFile(place, "wb") as file:
                yield CsvOutput(file, schema)
