"""The lines of a LabVIEW measurement file (LVM) as those of one plain table.

"Specification for the LabVIEW Measurement File (.lvm)" (National Instruments): a header of the file, and one of each
segment in front of its rows, each up to ***End_of_Header***.
"""

from __future__ import annotations

from collections.abc import Iterator

from punctura.trace.heading import with_unit
from punctura.trace.lines import Pieces

_BEGINNING, _END = "LabVIEW Measurement", "***End_of_Header***"


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
