"""What a file seems to hold, before it is read as a trace: for a program that asks its user what is not stated."""

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from punctura import Needle
from punctura.trace.columns import ROLES, candidates
from punctura.trace.read import recording_at
from punctura.trace.reading import Reading
from punctura.trace.table import check_file
from punctura.trace.tables import read_table
from punctura.trace.units import split_name

EXAMPLES = 3  # numbers of a column that are shown


@dataclass(frozen=True)
class Column:
    """A column of a file: its name, the unit in the name (empty if it is not stated), and its first numbers."""

    name: str
    unit: str
    examples: tuple[float, ...]


@dataclass(frozen=True)
class Guess:
    """The column that is known by its name to be the role; empty if none is, or more than one."""

    role: str
    column: str


@dataclass(frozen=True)
class Look:
    """What a file holds. A recording of Punctura states its columns, its units and its needle."""

    rows: int
    columns: tuple[Column, ...]
    guesses: tuple[Guess, ...]  # one for each of ROLES; none for a recording
    needle: Needle | None


def look_at(path: str | os.PathLike[str]) -> Look:
    """Reads the names and the first numbers of a trace file. Nothing is guessed. Raises TraceError, OSError."""
    path = Path(path)
    check_file(path)
    recording = recording_at(path)
    if recording is not None:
        return Look(recording.rows, (), (), recording.info.scene.needle)
    table = read_table(path, Reading())
    names = list(table)
    columns = tuple(
        Column(name, split_name(name)[1], tuple(cells[np.isfinite(cells)][:EXAMPLES].tolist()))
        for name, cells in table.items()
    )
    found = {role: candidates(role, names) for role in ROLES}
    guesses = tuple(Guess(role, names[at[0]] if len(at) == 1 else "") for role, at in found.items())
    return Look(len(next(iter(table.values()))), columns, guesses, None)
