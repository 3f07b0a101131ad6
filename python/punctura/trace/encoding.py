"""The encoding of a text file: by its bytes, and by the names of columns that it then holds.

A header of ten letters is too short for the statistics of a language (charset-normalizer 3.5 is wrong for 6 of 8 such
files), but its names are known: the right encoding is the one in which they stand.
"""

import codecs
import re
from pathlib import Path
from typing import NamedTuple

from punctura.trace.names import role_named
from punctura.trace.trace import TraceError
from punctura.trace.units import role_of, split_name

_OLD = ("cp1252", "gb18030", "cp932", "big5", "cp949", "euc_jp", "cp1251", "mac_roman")  # the first is meant in doubt
_HEAD = 1 << 16  # bytes, which hold the names
_PIECE = 1 << 20  # bytes


class Encoding(NamedTuple):
    """The encoding of a text file, and whether it is only a guess: names may be garbled, numbers are not."""

    name: str
    doubtful: bool = False


def encoding_of(path: Path, stated: str | None = None) -> Encoding:
    """The encoding of a text file. Raises TraceError for an unknown one, and for a file that is no text, OSError."""
    if stated is not None:
        try:
            return Encoding(codecs.lookup(stated).name)
        except LookupError:
            text = f"{path}: {stated!r} is no encoding; state one such as utf-8, utf-16, cp1252, gbk or shift_jis"
            raise TraceError(f"{text} (--encoding NAME)") from None
    with path.open("rb") as file:
        head = file.read(_HEAD)
    if head.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return Encoding("utf-16")
    if b"\0" in head[:4096]:
        halves = head[0:4096:2], head[1:4096:2]  # plain letters in UTF-16 have a zero in each second byte
        for name, zeros, letters in (("utf-16-le", *halves[::-1]), ("utf-16-be", *halves)):
            if 2 * zeros.count(0) > len(zeros) and not letters.count(0):
                return Encoding(name)
        raise TraceError(f"{path}: is no text, Parquet, MAT, XLSX or HDF5 file; export the table as CSV")
    return Encoding("utf-8-sig") if _is_utf8(path) else _old(head)


def _is_utf8(path: Path) -> bool:
    decoder = codecs.getincrementaldecoder("utf-8")()
    try:
        with path.open("rb") as file:
            while piece := file.read(_PIECE):
                decoder.decode(piece)
        decoder.decode(b"", final=True)
    except UnicodeDecodeError:
        return False
    return True


def _old(head: bytes) -> Encoding:
    """The encoding in which most names and units of columns are known."""
    lines = [line for line in head.split(b"\n") if not line.isascii()]
    known = {name: sum(map(_known, lines, [name] * len(lines))) for name in _OLD}
    best = max(_OLD, key=lambda name: known[name])  # the first of those that are alike
    runs = [run for line in lines for run in re.findall(rb"[\x80-\xff]+", line)]
    together = sum(len(run) for run in runs if len(run) > 1)  # in western languages they stand alone
    return Encoding(best, doubtful=not known[best] and 2 * together > sum(map(len, runs)))


def _known(line: bytes, encoding: str) -> int:
    """How many cells of a line with other letters than English ones are known names or units."""
    cells = [cell.strip(' "\r') for cell in re.split("[;,\t]", line.decode(encoding, "replace")) if not cell.isascii()]
    split = [split_name(cell) for cell in cells]
    return sum(bool(role_of(unit) if name.isascii() else role_named(name)) for name, unit in split)
