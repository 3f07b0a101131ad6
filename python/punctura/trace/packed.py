"""Refuses MAT and XLSX files that expand beyond what a trace may hold, before their readers take memory for it."""

import struct
import zipfile
import zlib
from pathlib import Path
from typing import IO

from punctura.trace.table import MOST_NUMBERS
from punctura.trace.trace import TraceError

MOST_BYTES = 8 * MOST_NUMBERS  # expanded
MOST_IN_STRUCTURES = 100_000_000  # expanded: a structure of many small parts takes 15 times as much memory
MOST_TEXTS = 64_000_000  # of the texts in the cells of a workbook
MOST_OF_A_PART = 8_000_000  # of any other part, such as the styles
_STEP = 1 << 20
_HEADER, _COMPRESSED = 128, 15  # bytes before the first element; the type of a compressed element


def expanded_bytes(path: Path, most: int = MOST_BYTES) -> int:
    """The size of a MAT file's elements when they are expanded; it stops counting above `most`. Raises OSError.

    "MAT-File Level 5 File Format" (The MathWorks): each element is a type, a number of bytes, and the bytes, which can
    be compressed with zlib. Version 4 has no compression.
    """
    total, size = 0, path.stat().st_size
    with path.open("rb") as file:
        head = file.read(_HEADER)
        order = {b"IM": "<", b"MI": ">"}.get(head[126:128])
        while order is not None and total <= most and len(tag := file.read(8)) == 8:
            kind, length = struct.unpack(f"{order}II", tag)
            end = file.tell() + length
            there = min(length, size - file.tell())  # a damaged file may state more
            total += _expanded(file, there, most) if kind == _COMPRESSED else there
            file.seek(end)
    return total


def _expanded(file: IO[bytes], length: int, most: int) -> int:
    zipped, total, left = zlib.decompressobj(), 0, length
    try:
        while total <= most and not zipped.eof:
            packed = zipped.unconsumed_tail or file.read(min(left, _STEP))
            if not packed:
                break
            left -= 0 if zipped.unconsumed_tail else len(packed)
            total += len(zipped.decompress(packed, _STEP))
    except zlib.error:
        pass  # the reader says so
    return total


def check_mat(path: Path, structures: bool) -> None:
    """Raises TraceError if the elements of a MAT file expand too far. structures: whether it holds some."""
    most = min(MOST_IN_STRUCTURES, MOST_BYTES) if structures else MOST_BYTES
    if expanded_bytes(path, most) > most:
        what = "structures of more than" if structures else "more than"
        remedy = "Save depth, force and time as one vector each, or fewer samples"
        raise TraceError(f"{path}: expands to {what} {most // 1_000_000:,} MB; that is the limit. {remedy}")


def holds_workbook(path: Path) -> bool:
    """Whether a ZIP file is a workbook of Excel. Raises OSError."""
    try:
        with zipfile.ZipFile(path) as archive:
            return "xl/workbook.xml" in archive.namelist()
    except zipfile.BadZipFile:
        return False


def check_workbook(path: Path) -> None:
    """Raises TraceError if a part of an XLSX file expands too far, OSError, zipfile.BadZipFile."""
    with zipfile.ZipFile(path) as archive:
        parts = archive.infolist()
    for part in parts:
        most = MOST_OF_A_PART
        if part.filename.startswith(("xl/worksheets/", "xl/media/", "xl/embeddings/")):
            most = MOST_BYTES
        elif part.filename == "xl/sharedStrings.xml":
            most = MOST_TEXTS
        if part.file_size > most:
            text = f"{path}: its part {part.filename[:60]!r} expands to {part.file_size // 1_000_000:,} MB"
            raise TraceError(f"{text}; the limit is {most // 1_000_000:,} MB. Export the table as CSV, or fewer rows")
