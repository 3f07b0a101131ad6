"""The lines of a text file, piece by piece: a file takes no more memory than its table.

A LabVIEW measurement file (LVM) becomes one plain table. "Specification for the LabVIEW Measurement File (.lvm)"
(National Instruments): a header of the file, and one of each segment in front of its rows, each up to
***End_of_Header***.
"""

import codecs
import io
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from punctura.trace.heading import with_unit
from punctura.trace.table import LONGEST_NAME, MOST_COLUMNS
from punctura.trace.trace import TraceError

LOOKED_AT = 200  # lines at the end, which show delimiter and width
MOST_ABOVE = 5000  # lines at the start, among which the table begins
MOST_BYTES = 500_000_000  # the cells of a table take a few times as much memory
_LONGEST_LINE = LONGEST_NAME * MOST_COLUMNS  # characters
_MOST_JOINED = 20  # lines of a row
_PIECE = 1 << 20  # bytes
_BEGINNING, _END = "LabVIEW Measurement", "***End_of_Header***"  # of an LVM file


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
        first += lines[: MOST_ABOVE - len(first)]
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


def joined(lines: Sequence[str]) -> list[tuple[str, int]]:
    """The lines, and of how many each is made: a cell in quotes may go over several lines, as the name of a column."""
    found: list[tuple[str, int]] = []
    at = 0
    while at < len(lines):
        ends = (n for n in range(1, _MOST_JOINED + 1) if sum(line.count('"') for line in lines[at : at + n]) % 2 == 0)
        count = next(ends, 1)
        found.append((" ".join(lines[at : at + count]), count))
        at += count
    return found


def is_comment(line: str) -> bool:
    return line.startswith(("#", "%"))


def is_lvm(pieces: Pieces) -> bool:
    """Whether these are the lines of an LVM file."""
    return any(line.startswith(_BEGINNING) for line in next(pieces(), [])[:1])


def lvm_lines(pieces: Pieces) -> Iterator[list[str]]:
    """The names of the columns with their units, then the rows of all segments, without headers and comments.

    A file without X values gets them from X0 and Delta_X.
    """
    header: dict[str, list[str]] = {}
    separator, point, head, names, row = "\t", ".", True, [""], 0
    for lines in pieces():
        table = []
        for line in lines:
            key, *values = line.split(separator)
            if line.startswith(_BEGINNING):
                head = True
            elif key == "Separator":
                separator = "," if values[:1] == ["Comma"] or line[9:10] == "," else "\t"
            elif key == "Decimal_Separator":
                point = (values or ["."])[0]
            elif line.startswith(_END):
                head = False
            elif key in ("Channels", "Samples", "X0", "Delta_X", "Y_Unit_Label", "X_Dimension"):
                header[key], head = values, True
            elif key == "X_Value":
                new = _names([key, *values], header)
                table += [] if new == names else [separator.join(new)]
                names, row = new, 0
            elif not head and len(names) > 1:
                cells = line.split(separator)[: len(names)]
                if not cells[0].strip():
                    time = _number(header, "X0") + row * _number(header, "Delta_X")
                    cells[0] = repr(time).replace(".", point)
                table.append(separator.join(cells))
                row += 1
        yield table


def _names(names: list[str], header: dict[str, list[str]]) -> list[str]:
    """The names with their units, without the column of comments behind them. Y_Unit_Label has one for each channel."""
    names = [name for name in names if name and name != "Comment"]
    others = [i for i, name in enumerate(names) if name != "X_Value"]
    channels = _number(header, "Channels")
    if channels < len(others):
        names = names[: others[int(channels)]]  # the comments have a name in the language of the program
    units, channel = header.get("Y_Unit_Label", []), 0
    if len(names) > len(others) + 1 and not any(units[1 : 2 * len(others) : 2]):
        units = units[::2]  # each channel has two columns, of X and Y
    time = "s" if header.get("X_Dimension", ["Time"])[:1] in ([], [""], ["Time"]) else ""
    labelled = []
    for name in names:
        if name == "X_Value":
            labelled.append(with_unit(name, time))
        else:
            labelled.append(with_unit(name, units[channel] if channel < len(units) else ""))
            channel += 1
    return labelled


def _number(header: dict[str, list[str]], key: str) -> float:
    try:
        return float(header[key][0].replace(",", "."))
    except (KeyError, IndexError, ValueError):
        return float("nan")
