"""Reads a motion from a Parquet or NumPy file in blocks of rows."""

from __future__ import annotations

import zipfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from punctura.simulation.columns import AXIS, TIME_AND_POSITION, MotionError
from punctura.simulation.motion_file import Block

ROWS = 1 << 16
MOST_EXPANDED = 800_000_000  # bytes of an .npz file, which is in memory as a whole: 100 million numbers

Array = NDArray[np.float64]


class MotionTable:
    """The rows of a .parquet, .npy or .npz file. It has the members of MotionFile. Rows are counted from 1."""

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            names, self.size = self._parquet() if path.suffix.lower() == ".parquet" else self._numpy()
        except (pa.ArrowException, ValueError, EOFError, MemoryError, zipfile.BadZipFile, KeyError) as bad:
            if isinstance(bad, MotionError):
                raise
            raise MotionError(path, 0, f"cannot be read as a {path.suffix} file ({bad})") from None
        self.has_axis = set(AXIS) <= set(names)
        self.columns = TIME_AND_POSITION + (AXIS if self.has_axis else [])
        if self.size == 0:
            raise MotionError(path, 0, "has no rows")

    def blocks(self) -> Iterator[Block]:
        """Yields the motion from its start, 65,536 rows at a time."""
        first = 1
        for rows in self._rows():
            if len(bad := np.argwhere(~np.isfinite(rows))):
                i, j = (int(number) for number in bad[0])
                what = f"{self.columns[j]} is {rows[i, j]}; fill the sample in, or cut the motion there"
                raise MotionError(self.path, first + i, what)
            axis = rows[:, 4:7] if self.has_axis else None
            yield Block(first, first - 1 + len(rows), rows[:, 0], rows[:, 1:4], axis)
            first += len(rows)

    def _rows(self) -> Iterator[Array]:
        if self.path.suffix.lower() != ".parquet":
            for i in range(0, self.size, ROWS):
                yield np.column_stack([part[i : i + ROWS] for part in self._parts]).astype(np.float64)
            return
        with pq.ParquetFile(self.path) as file:
            batches = file.iter_batches(ROWS, columns=self.columns)
            while True:
                try:
                    batch = next(batches, None)
                except (pa.ArrowException, OSError) as bad:  # a failing disk has an errno, a damaged page none
                    if isinstance(bad, OSError) and bad.errno is not None:
                        raise
                    raise MotionError(self.path, 0, "is damaged: its rows cannot be read; write it again") from None
                if batch is None:
                    return
                columns = [
                    batch.column(name).cast(pa.float64()).to_numpy(zero_copy_only=False) for name in self.columns
                ]
                yield np.column_stack(columns)

    def _parquet(self) -> tuple[list[str], int]:
        with pq.ParquetFile(self.path) as file:
            schema = file.schema_arrow
            for name in TIME_AND_POSITION + AXIS:
                if name not in schema.names:
                    if name in TIME_AND_POSITION:
                        raise MotionError(self.path, 0, f"column {name} is missing; it needs {_WANTED}")
                elif not (pa.types.is_floating(kind := schema.field(name).type) or pa.types.is_integer(kind)):
                    raise MotionError(self.path, 0, f"column {name} holds {kind}, not numbers")
            return schema.names, file.metadata.num_rows

    def _numpy(self) -> tuple[list[str], int]:
        if zipfile.is_zipfile(self.path):
            with zipfile.ZipFile(self.path) as archive:
                size = sum(part.file_size for part in archive.infolist())
            if size > MOST_EXPANDED:
                what = f"expands to {size / 1e6:,.0f} MB; the limit is {MOST_EXPANDED / 1e6:,.0f} MB"
                raise MotionError(self.path, 0, f"{what}. Save it as .npy or .parquet, which are read in parts")
        loaded = np.load(self.path, mmap_mode="r", allow_pickle=False)
        if isinstance(loaded, np.ndarray):
            if loaded.ndim != 2 or loaded.shape[1] not in (4, 7):
                what = f"has shape {loaded.shape}; it must be (n, 4) or (n, 7), with the columns {_WANTED}"
                raise MotionError(self.path, 0, what)
            self._parts = [loaded]
        else:
            with loaded:
                for name in ("time", "position"):
                    if name not in loaded:
                        what = f"has no array {name!r}; give time (n,), position (n, 3) and perhaps axis (n, 3)"
                        raise MotionError(self.path, 0, what)
                self._parts = [loaded[name] for name in ("time", "position", "axis") if name in loaded]
            n = len(np.atleast_1d(self._parts[0]))
            for name, part, shape in zip(
                ("time", "position", "axis"), self._parts, ((n,), (n, 3), (n, 3)), strict=False
            ):
                if part.shape != shape:
                    raise MotionError(self.path, 0, f"{name} has shape {part.shape}, not {shape}")
        for part in self._parts:
            if part.dtype.kind not in "iuf":
                raise MotionError(self.path, 0, f"holds {part.dtype}, not real numbers")
        wide = sum(1 if part.ndim == 1 else part.shape[1] for part in self._parts) == 7
        return TIME_AND_POSITION + (AXIS if wide else []), len(self._parts[0])


_WANTED = f"{','.join(TIME_AND_POSITION)}[,{','.join(AXIS)}]"
