"""Writes figure data as CSV."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from punctura.reproduce.drawing import Table


def write_csv(table: Table, path: Path) -> None:
    """One row per sample. Numbers have the shortest form that reads back identically. NaN is an empty cell."""
    columns = [_cells(column) for column in table.values()]
    lines = [",".join(table), *map(",".join, zip(*columns, strict=True))]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")


def _cells(column: object) -> list[str]:
    array = np.asarray(column)
    if array.dtype.kind == "f":
        return ["" if x != x else repr(x) for x in array.tolist()]
    return [str(x) for x in array.tolist()]
