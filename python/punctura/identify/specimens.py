"""The specimens of a file with several sheets as a folder of traces."""

from __future__ import annotations

import re
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet

from punctura.files.whole_file import write_whole
from punctura.trace.reading import Reading
from punctura.trace.sheets import SheetError
from punctura.trace.tables import read_table


def write_specimens(path: Path, reading: Reading, folder: Path) -> None:
    """Writes each table of a file that can be a trace to `folder` as Parquet. Raises TraceError, OSError.

    A file with the same table is left as it is, so that its result is kept; one of a former specimen is removed.
    """
    try:
        tables = {path.stem: read_table(path, reading)}
    except SheetError as several:
        if reading.sheet is not None:
            raise
        tables = {name: read_table(path, replace(reading, sheet=name)) for name in several.sheets}
    folder.mkdir(parents=True, exist_ok=True)
    written = set()
    for number, (name, table) in enumerate(tables.items(), 1):
        plain = re.sub(r"[^\w .-]", "_", name)[:80]
        place = folder / f"{number:02}-{plain}.parquet"
        held = BytesIO()
        pa.parquet.write_table(pa.table(dict(table)), held)
        if not place.exists() or place.read_bytes() != held.getvalue():
            write_whole(place, held.getvalue())
        written.add(place)
    for former in set(folder.glob("[0-9]*-*.parquet")) - written:
        former.unlink()
