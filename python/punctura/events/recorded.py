"""Events of a recording."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pyarrow as pa

from punctura import Scene
from punctura.events.event import Event
from punctura.events.finder import EventFinder
from punctura.record import Recording
from punctura.record.columns import NEW_SCENES, ticks_of
from punctura.record.header import from_text
from punctura.ticks import Ticks


def recorded_ticks(recording: Recording) -> Iterator[tuple[Ticks, Scene | None]]:
    """Yields all ticks in order. The scene is set after a scene change, else None."""
    for batch in recording.batches():
        start = 0
        for row, texts in _new_scenes(batch):
            if row > start:
                yield ticks_of(batch.slice(start, row - start)), None
            end = next((later for later, _ in _new_scenes(batch) if later > row), len(batch))
            yield ticks_of(batch.slice(row, end - row)), from_text(texts[-1], recording.path)
            start = end
        if start < len(batch):
            yield ticks_of(batch.slice(start)), None


def _new_scenes(batch: pa.RecordBatch) -> list[tuple[int, list[str]]]:
    if NEW_SCENES not in batch.schema.names:
        return []
    column = batch.column(NEW_SCENES)
    rows = np.flatnonzero(np.asarray(column.is_valid()))
    return [(int(row), texts) for row in rows if (texts := column[int(row)].as_py())]


def events_of(recording: Recording, scene: Scene | None) -> list[Event]:
    """See find_events."""
    first = scene or recording.info.scene
    finder = EventFinder(first, first.servo.rate)
    events: list[Event] = []
    for ticks, new_scene in recorded_ticks(recording):
        if new_scene is not None:
            finder.change(new_scene)
        events += finder.add(ticks)
    return events
