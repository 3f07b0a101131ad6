"""The lines of a text file, piece by piece: a file takes no more memory than its table."""

from __future__ import annotations

import codecs
import io
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

from punctura.trace.size import LONGEST_NAME, MOST_COLUMNS
from punctura.trace.trace import TraceError

LOOKED_AT = 200  # lines at the end, which show delimiter and width; lines at the start, which may stand above the table
MOST_BYTES = 500_000_000  # the cells of a table take a few times as much memory
_LONGEST_LINE = LONGEST_NAME * MOST_COLUMNS  # characters
_PIECE = 1 << 20  # bytes


Pieces = Callable[[], Iterator[list[str]]]  # reads the lines of a file from its start


class Survey(NamedTuple):
    """What a text file holds. Blank lines do not count."""

    first: list[str]  # lines, with comments
    last: list[str]  # lines that are no comments
    rows: int  # lines that are no comments


def survey(pieces: Pieces) -> Survey:
    """Reads a text file once. Raises TraceError for a line that is too long, OSError."""
    first: list[str] = []
    last: list[str] = []
    count = 0
    for lines in pieces():
        first += lines[: LOOKED_AT - len(first)]
        rows = [line for line in lines if not is_comment(line)]
        last = (last + rows)[-LOOKED_AT:]
        count += len(rows)
    return Survey(first, last, count)


def read_lines(path: Path, encoding: str) -> Iterator[list[str]]:
    """Yields the lines that are not blank, some thousands at a time. Raises TraceError for a line that is too long."""
    decoder = io.IncrementalNewlineDecoder(codecs.getincrementaldecoder(encoding)("replace"), translate=True)
    begun, data = "", b"-"
    with path.open("rb") as file:
        while data:
            data = file.read(_PIECE)
            text = begun + decoder.decode(data, final=not data)
            end = text.rfind("\n") + 1 if data else len(text)
            text, begun = text[:end], text[end:]
            while "\n\n" in text:  # a piece of blank lines would be a million lines
                text = text.replace("\n\n", "\n")
            lines = [line for line in text.split("\n") if line and not line.isspace()]
            if max(map(len, [*lines, begun])) > _LONGEST_LINE:
                raise TraceError(f"{path}: a line has more than {_LONGEST_LINE:,} characters; export it again")
            yield lines


def is_comment(line: str) -> bool:
    return line.startswith(("#", "%"))
