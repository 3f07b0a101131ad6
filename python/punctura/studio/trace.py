"""Decimates a recording for a drawing: depth and force over time, with every peak and every pop."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from punctura import Scene
from punctura.compare.run import resistance
from punctura.events import EventFinder
from punctura.events.recorded import recorded_ticks
from punctura.record import Recording
from punctura.studio.view import membrane_views
from punctura.studio.wire.common import Finite, MembraneView, Part
from punctura.ticks import Columns

FEWEST, MOST, USUAL = 60, 3000, 2400  # rows of an answer; MOST rows are below 100 kB
EACH = 6  # rows that a bucket keeps at most: first, last, and the extremes of depth and force
MOST_EVENTS = 40  # events at which a bucket ends, so that rows between two events are kept
Array = npt.NDArray[np.float64]


class RecordingTrace(Part):
    """A drawing of a recording. None: a gap."""

    time: list[Finite]  # s, of the run
    depth: list[Finite | None]  # m, of the tip below the first surface
    force: list[Finite | None]  # N, size of the model's total force, negative if it pulls the needle in
    membranes: list[MembraneView]


def thinned_trace(recording: Recording, start: float = 0.0, points: int = USUAL) -> RecordingTrace:
    """The trace from `start` (s of the run) on. The maximum of its force is an exercise's `peak_force`. Raises
    RecordingError.

    Each bucket of ticks keeps its first and last row, and those of the lowest and highest depth and force. A bucket
    ends at each of the first MOST_EVENTS events. A row of nulls breaks the curves at lost ticks.
    """
    info = recording.info
    rate = info.scene.servo.rate
    skipped = max(0.0, start * rate - float(recording.summary.first_tick))
    size = max(1, math.ceil(max(recording.rows - skipped, 1.0) * EACH / points))
    thin = _Thinner(size)
    kept = [thin.add(*part) for part in _rows(recording, start)]
    rows = np.concatenate([*kept, thin.end()])
    return RecordingTrace(
        time=rows[:, 0].round(5).tolist(),
        depth=_rounded(rows[:, 1], 7),
        force=_rounded(rows[:, 2], 5),
        membranes=membrane_views(info.scene),
    )


def _rounded(values: Array, digits: int) -> list[float | None]:
    return [None if np.isnan(v) else round(float(v), digits) for v in values]


def _rows(recording: Recording, start: float) -> Iterator[tuple[Array, npt.NDArray[np.bool_]]]:
    """Batches (n, 3) of time, depth and force, and the rows that end a bucket: at and before an event, and at gaps."""
    scene = recording.info.scene
    finder = EventFinder(scene, scene.servo.rate)
    events = 0
    next_tick: int | None = None
    for columns, new_scene in recorded_ticks(recording):
        if new_scene is not None:
            finder.change(new_scene)
        found = [event.tick for event in finder.add(columns)][: MOST_EVENTS - events]
        events += len(found)
        tick = columns["tick"].astype(np.int64)
        rows = np.stack([columns["time"].astype(np.float64), *_drawn(columns, scene)], axis=1)
        keep = np.isin(tick, found) | np.isin(tick + 1, found)
        gaps = np.flatnonzero(np.diff(tick, prepend=tick[0] - 1 if next_tick is None else next_tick - 1) != 1)
        next_tick = int(tick[-1]) + 1
        breaks = np.column_stack([rows[gaps, 0], np.full((len(gaps), 2), np.nan)])
        rows, keep = np.insert(rows, gaps, breaks, axis=0), np.insert(keep, gaps, True)
        late = rows[:, 0] >= start
        if late.any():
            yield rows[late], keep[late]


def _drawn(columns: Columns, scene: Scene) -> tuple[Array, Array]:
    first = scene.membranes[0]
    normal = np.asarray(first.inward_normal, np.float64)
    normal = normal / np.linalg.norm(normal)
    depth = (columns["tip"] - np.asarray(first.point)) @ normal
    return depth, resistance(columns["model_force"], columns["axis"])


class _Thinner:
    """Takes rows in batches of any size, and collects them in buckets of at most `size` rows."""

    def __init__(self, size: int) -> None:
        self._size = size
        self._rest, self._keep = np.empty((0, 3)), np.empty(0, dtype=np.bool_)

    def add(self, rows: Array, keep: npt.NDArray[np.bool_]) -> Array:
        """The kept rows of all full buckets."""
        rows, keep = np.concatenate([self._rest, rows]), np.concatenate([self._keep, keep])
        full = len(rows) // self._size * self._size
        self._rest, self._keep = rows[full:], keep[full:]
        return rows[:full][self._chosen(rows[:full], keep[:full])]

    def end(self) -> Array:
        """The kept rows of the last bucket."""
        return self._rest[self._chosen(self._rest, self._keep)]

    def _chosen(self, rows: Array, keep: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
        chosen = np.zeros(len(rows), dtype=np.bool_)
        cuts = np.union1d(np.arange(0, len(rows), self._size), np.flatnonzero(keep) + 1)
        for start, end in itertools.pairwise([*cuts[cuts < len(rows)].tolist(), len(rows)]):
            chosen[[start, end - 1]] = True
            for values in rows[start:end, 1:].T:
                if not np.isnan(values).all():
                    chosen[[start + int(np.nanargmin(values)), start + int(np.nanargmax(values))]] = True
        return chosen
