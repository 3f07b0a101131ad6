"""Events of a recording, and its ticks as the columns that a listener gives."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from punctura import Scene
from punctura.events.event import Event
from punctura.events.finder import Columns, EventFinder
from punctura.record import Recording
from punctura.record.columns import AXES, NEW_SCENES
from punctura.record.scene_text import from_text
from punctura.record.schema import NO_PHASE as NO_WORD
from punctura.record.schema import membranes_in, numbers

_SCALARS = {"tick": "tick", "time": "time_s", "ceiling": "ceiling_N"}
_PLAIN = ("state", "fault", "limit", "commands", "buttons", "lost")
_VECTORS = {"position": "{}_m", "axis": "axis_{}", "tip": "tip_{}_m", "force": "f{}_N", "model_force": "model_f{}_N"}
_EACH = {"depth": "depth_{}_m", "axial_force": "force_{}_N", "lower": "lower_{}_N", "upper": "upper_{}_N",
         "phase": "phase_{}"}  # fmt: skip
_EACH_VECTOR = {"proxy": "proxy_{}_{}_m", "direction": "direction_{}_{}"}


def snapshot_columns(batch: pa.RecordBatch) -> Columns:
    """A batch of a recording as Listener.read() gives it. Of membranes that a tick did not have: NaN, phase 255."""
    names = set(batch.schema.names)
    count = membranes_in(batch.schema)

    def column(name: str) -> NDArray[Any]:
        return numbers(batch, name)

    columns: Columns = {name: column(flat) for name, flat in _SCALARS.items() if flat in names}
    columns.update({name: column(name) for name in _PLAIN if name in names})
    columns.setdefault("limit", np.full(len(batch), NO_WORD, np.uint8))  # recordings of format 1 do not say
    for name, pattern in _VECTORS.items():
        if pattern.format("x") in names:
            columns[name] = np.stack([column(pattern.format(a)) for a in AXES], axis=1)
    for name, pattern in _EACH.items():
        each = [column(pattern.format(i)) for i in range(count)]
        kind = np.uint8 if name == "phase" else np.float64
        columns[name] = np.stack(each, axis=1).astype(kind) if each else np.empty((len(batch), 0), kind)
    for name, pattern in _EACH_VECTOR.items():
        if count and pattern.format(0, "x") in names:
            rows = [np.stack([column(pattern.format(i, a)) for a in AXES], axis=1) for i in range(count)]
            columns[name] = np.stack(rows, axis=1)
    return columns


def recorded_ticks(recording: Recording) -> Iterator[tuple[Columns, Scene | None]]:
    """All ticks in turn. scene is set after a scene change, else None."""
    for batch in recording.batches():
        start = 0
        for row, texts in _new_scenes(batch):
            if row > start:
                yield snapshot_columns(batch.slice(start, row - start)), None
            end = next((later for later, _ in _new_scenes(batch) if later > row), len(batch))
            yield snapshot_columns(batch.slice(row, end - row)), from_text(texts[-1], recording.path)
            start = end
        if start < len(batch):
            yield snapshot_columns(batch.slice(start)), None


def _new_scenes(batch: pa.RecordBatch) -> list[tuple[int, list[str]]]:
    if NEW_SCENES not in batch.schema.names:
        return []
    column = batch.column(NEW_SCENES)
    rows = np.flatnonzero(np.asarray(column.is_valid()))
    return [(int(row), texts) for row in rows if (texts := column[int(row)].as_py())]


def find_events(recording: Recording, scene: Scene | None = None) -> list[Event]:
    """All events of a recording. scene: in place of the one that the recording names. Raises RecordingError."""
    first = scene or recording.info.scene
    finder = EventFinder(first, first.servo.rate)
    events: list[Event] = []
    for columns, new_scene in recorded_ticks(recording):
        if new_scene is not None:
            finder.change(new_scene)
        events += finder.add(columns)
    return events
