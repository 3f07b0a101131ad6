"""The numbers of traces as a table, and what a folder of traces has in common."""

from collections.abc import Sequence
from dataclasses import asdict, fields, replace
from pathlib import Path
from typing import TypedDict

import numpy as np
import pyarrow as pa

from punctura.defects import PATIENCE_S, explain
from punctura.files.names import as_text
from punctura.trace.numbers import InsertionNumbers, numbers_of
from punctura.trace.read import read_as
from punctura.trace.reading import Reading, SheetError
from punctura.trace.trace import Trace, TraceError

Row = dict[str, str | int | float | None]  # a row of the table: the columns depend on the number of pops


class SpreadRecord(TypedDict):
    """A number over the traces of a folder. sd: None for one trace."""

    insertion: int
    name: str
    traces: int
    mean: float
    sd: float | None
    least: float
    greatest: float


class MeasuredRecord(TypedDict):
    """The JSON of `punctura measure --json`."""

    rows: list[Row]
    folder: list[SpreadRecord]  # empty for one trace
    findings: dict[str, list[str]]  # what is unusual, by the name of the trace
    failed: dict[str, str]  # the reason by the name of the trace


def rows_of(trace: Trace, name: str, angle: float = 0.0) -> list[Row]:
    """A row for each insertion of a trace. angle: as in numbers_of(). Raises TraceError, also for a severe finding."""
    severe = [finding for finding in trace.findings if finding.severe]
    if severe:
        raise TraceError(f"{trace.source or 'the trace'}: {severe[0]}")
    return [_row(name, numbers) for numbers in numbers_of(trace, angle)]


def _row(name: str, numbers: InsertionNumbers) -> Row:
    row: Row = {"trace": name}
    row |= {one.name: getattr(numbers, one.name) for one in fields(numbers) if one.name != "pops"}
    row["pops"] = len(numbers.pops)
    return row | {f"pop[{i}].{key}": value for i, pop in enumerate(numbers.pops) for key, value in asdict(pop).items()}


def measured(paths: Sequence[Path], reading: Reading, angle: float = 0.0) -> MeasuredRecord:
    """The rows of several files; each sheet of a workbook is a trace. A file that cannot be read stops no other."""
    found: MeasuredRecord = {"rows": [], "folder": [], "findings": {}, "failed": {}}
    for path in paths:
        name = as_text(path.name)
        try:
            _add(found, path, name, reading, angle)
        except SheetError as several:
            if reading.sheet is not None:
                found["failed"][name] = str(several)
                continue
            for sheet in several.sheets:
                try:
                    _add(found, path, f"{name}: {sheet}", replace(reading, sheet=sheet), angle)
                except Exception as error:
                    found["failed"][f"{name}: {sheet}"] = explain(error, PATIENCE_S)
        except Exception as error:
            found["failed"][name] = explain(error, PATIENCE_S)
    if len({row["trace"] for row in found["rows"]}) > 1:
        found["folder"] = spread(found["rows"])
    return found


def _add(found: MeasuredRecord, path: Path, name: str, reading: Reading, angle: float) -> None:
    trace = read_as(path, reading)
    found["rows"] += rows_of(trace, name, angle)
    found["findings"][name] = [str(finding) for finding in trace.findings]


def spread(rows: Sequence[Row]) -> list[SpreadRecord]:
    """Mean, standard deviation and bounds of each number over the traces, insertion by insertion."""
    found: list[SpreadRecord] = []
    insertions = sorted({int(row["insertion"] or 0) for row in rows})
    for insertion in insertions:
        of_this = [row for row in rows if row["insertion"] == insertion]
        for name in columns(of_this):
            held = [row.get(name) for row in of_this]
            values = np.array([value for value in held if isinstance(value, int | float)])
            if name in ("trace", "insertion") or not len(values):
                continue
            sd = float(np.std(values, ddof=1)) if len(values) > 1 else None
            found.append(
                {"insertion": insertion, "name": name, "traces": len(values), "mean": float(values.mean()), "sd": sd,
                 "least": float(values.min()), "greatest": float(values.max())}
            )  # fmt: skip
    return found


def columns(rows: Sequence[Row]) -> list[str]:
    """The columns of the table, in the order of the row with the most pops."""
    return list(dict.fromkeys(name for row in sorted(rows, key=lambda row: -len(row)) for name in row))


def table_of(rows: Sequence[Row]) -> pa.Table:
    """The rows as a table; a missing number is null."""
    kinds = {"trace": pa.string(), "insertion": pa.int64(), "pops": pa.int64()}
    names = columns(rows)
    held = [pa.array([row.get(name) for row in rows], kinds.get(name, pa.float64())) for name in names]
    return pa.Table.from_arrays(held, names)


def in_words(found: MeasuredRecord) -> str:
    """The rows, and the spread of a folder, as lines for a reader, in mm, N, N/mm and mJ."""
    lines = []
    for row in found["rows"]:
        lines.append(f"{row['trace']}, insertion {row['insertion']}:")
        lines += [
            f"  {_plain(name):20} {_shown(name, row[name])}" for name in row if name not in ("trace", "insertion")
        ]
    for one in found["folder"]:
        name, sd = one["name"], "-" if one["sd"] is None else _shown(one["name"], one["sd"])
        between = f"{_shown(name, one['least'])} to {_shown(name, one['greatest'])}"
        lines.append(f"{one['traces']} traces, insertion {one['insertion']}: {_plain(name)}: "
                     f"mean {_shown(name, one['mean'])}, sd {sd}, {between}")  # fmt: skip
    lines += [f"{name}: {finding}" for name, all_of_it in found["findings"].items() for finding in all_of_it]
    lines += [f"{name}: {reason}" for name, reason in found["failed"].items()]
    return "\n".join(lines)


_SHOWN = {"_N_per_m": (1e-3, "N/mm"), "_m_per_s": (1e3, "mm/s"), "_m": (1e3, "mm"), "_J": (1e3, "mJ"), "_N": (1, "N")}


def _unit(name: str) -> str:
    """The ending of a column that states its unit; empty for a count."""
    return next((ending for ending in _SHOWN if name.endswith(ending)), "")


def _plain(name: str) -> str:
    """The name of a column without its unit."""
    return name.removesuffix(_unit(name)).replace("_", " ")


def _shown(name: str, value: str | float | None) -> str:
    if value is None or isinstance(value, str):
        return "-"
    factor, unit = _SHOWN.get(_unit(name), (1, ""))
    return f"{value * factor:.4g} {unit}".rstrip()
