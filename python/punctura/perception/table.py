"""All trials as one tidy table, one row for each answered trial, with a data dictionary."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa

from punctura.perception.analysis import felt_level
from punctura.perception.course import counted
from punctura.perception.protocol import Protocol
from punctura.results import JsonObject
from punctura.ticks.files import save

# Column, type, unit, meaning. "comparison" is the interval that has the level of the trial.
DICTIONARY: tuple[tuple[str, pa.DataType, str, str], ...] = (
    ("participant", pa.string(), "", "pseudonym"),
    ("participant_number", pa.int64(), "", "from 0, decides the order of the trials"),
    ("trial", pa.int64(), "", "number of the trial in the session, from 0, practice included"),
    ("block", pa.int64(), "", "from 0"),
    ("kind", pa.string(), "", "practice, trial or catch; only trial is in the fit"),
    ("level", pa.float64(), "that of the variable", "planned level of the comparison"),
    ("felt_level", pa.float64(), "that of the variable", "the level as it was felt, if the variable is in newtons"),
    ("position", pa.int64(), "", "interval of the comparison, from 0"),
    ("answer", pa.string(), "", "as the task names it"),
    ("counted", pa.bool_(), "", "whether the answer is yes, the comparison or right; empty for numbers and settings"),
    ("drop_N", pa.float64(), "N", "felt drop at the pop of the judged membrane, in the comparison"),
    ("peak_N", pa.float64(), "N", "largest felt force of the comparison"),
    ("roughness_N", pa.float64(), "N", "rms of what changes faster than 20 ms before the pop, in the comparison"),
    ("speed_m_per_s", pa.float64(), "m/s", "mean speed of the needle inwards, in the comparison"),
    ("force_scale", pa.float64(), "", "how much of the model's force the device gave"),
    ("reference_drop_N", pa.float64(), "N", "felt drop, mean of the other intervals; empty without them"),
    ("reference_peak_N", pa.float64(), "N", "largest felt force, mean of the other intervals; empty without them"),
    ("recordings", pa.string(), "", "file of the trial, with all its intervals"),
    ("time", pa.string(), "", "of the answer, ISO 8601, UTC"),
)  # fmt: skip
TABLES = ("trials.csv", "trials.parquet", "dictionary.csv")
_OF_FELT = {"drop_N": "drop", "peak_N": "peak", "roughness_N": "roughness", "speed_m_per_s": "speed"}


def table_of(protocol: Protocol, sessions: Mapping[str, Sequence[JsonObject]]) -> pa.Table:
    """The table of sessions: their lines by pseudonym, the header first."""
    rows = [_row(protocol, lines[0], line) for lines in sessions.values() for line in lines[1:]]
    schema = pa.schema([pa.field(name, kind) for name, kind, *_ in DICTIONARY])
    return pa.Table.from_pylist(rows, schema)


def _row(protocol: Protocol, header: JsonObject, line: JsonObject) -> JsonObject:
    lacks = protocol.rates or protocol.adjusts
    felt = list(line["felt"])
    mine = felt.pop(int(line["position"]))
    row = {name: line[name] for name in ("trial", "block", "kind", "level", "position", "answer", "time")}
    row |= {
        "participant": header["participant"],
        "participant_number": header["number"],
        "felt_level": felt_level(protocol, line)[0] if protocol.in_newtons else None,
        "counted": None if lacks else bool(counted(protocol, int(line["position"]), str(line["answer"]))),
        "force_scale": mine["scale"],
        "recordings": ";".join(line.get("recordings", ())),
    }
    row |= {name: mine[key] for name, key in _OF_FELT.items()}
    for name in ("drop", "peak"):
        row[f"reference_{name}_N"] = float(np.mean([one[name] for one in felt])) if felt else None
    return row


def save_tables(protocol: Protocol, sessions: Mapping[str, Sequence[JsonObject]], folder: Path) -> list[Path]:
    """Writes trials.csv, trials.parquet and dictionary.csv, and returns their paths. Raises OSError."""
    table = table_of(protocol, sessions)
    columns = zip(*((name, str(kind), unit, text) for name, kind, unit, text in DICTIONARY), strict=True)
    words = pa.table(dict(zip(("column", "type", "unit", "meaning"), map(list, columns), strict=True)))
    paths = [folder / name for name in TABLES]
    for path, content in zip(paths, (table, table, words), strict=True):
        save(content, path, private=True)
    return paths
