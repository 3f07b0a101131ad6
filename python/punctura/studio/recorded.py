"""A recording for the page: its scene and events, its ticks in the frames of a live run, and a drawing of it."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from punctura import Phase, Scene
from punctura._core import force_scale
from punctura.compare.run import resistance
from punctura.errors import ConfigurationError
from punctura.events.finder import recorded_events
from punctura.exercise.depths import PARALLEL
from punctura.exercise.ticks import Geometry, judged_depth
from punctura.record import Recording
from punctura.record.columns import ticks_of
from punctura.studio.loaded import Loaded, from_tables, from_text
from punctura.studio.pump import MOST_TICKS
from punctura.studio.view import law_curves, membrane_views, obliquities, scene_view
from punctura.studio.wire.common import Finite, LawCurve, MembraneView, Part, SceneView
from punctura.studio.wire.frames import encode_ticks, joined
from punctura.studio.wire.messages import MembraneEvent
from punctura.ticks import ABSENT, INSIDE, Columns, Ticks

MOTION_HZ = 250.0  # sampling rate of a recorded motion for the hand; Target smooths between the samples
FEWEST, MOST, USUAL = 60, 3000, 2400  # rows of an answer; MOST rows are below 100 kB
EACH = 6  # rows that a bucket keeps at most: first, last, and the extremes of depth and force
MOST_EVENTS = 40  # events at which a bucket ends, so that rows between two events are kept
Array = npt.NDArray[np.float64]


def loaded_of(recording: Recording) -> Loaded:
    """The recording's first scene, with its file's keys if the recording has them. Raises RecordingError."""
    info = recording.info
    tables = info.about.get("scene")
    if isinstance(tables, dict):
        try:
            return from_tables(tables)
        except ConfigurationError:
            pass  # tables of another version; the scene's own text is always present
    try:
        return from_text(info.header.scene)
    except ConfigurationError:
        return from_text(_text_of(recording))


def _text_of(recording: Recording) -> str:
    from punctura.scene import scene_text

    return scene_text(recording.info.scene)


class RecordingOverview(Part):
    """A recording without its ticks."""

    scene: SceneView
    events: list[MembraneEvent]
    ticks: int
    first_tick: int


def overview(recording: Recording) -> RecordingOverview:
    """All except the ticks. Reads the whole recording to find its events."""
    info = recording.info
    loaded = loaded_of(recording)
    view = scene_view(loaded, 0, info.scene.servo.rate, _scale(recording), _laws(loaded.scene, recording))
    return RecordingOverview(
        scene=view,
        events=[MembraneEvent(**dict(one)) for _, found in recorded_events(recording) for one in found],
        ticks=recording.rows,
        first_tick=max(0, recording.summary.first_tick),
    )


def _scale(recording: Recording) -> float:
    """The force scale of the first tick: what the device gave, also with rivals or by another version."""
    pieces = (ticks_of(batch) for batch in recording.batches())
    first = next((ticks.force_scale[0] for ticks in pieces if len(ticks)), None)
    return force_scale(recording.info.scene, recording.info.limits) if first is None else float(first)


def _laws(scene: Scene, recording: Recording) -> list[LawCurve] | None:
    """The laws for each membrane's first direction of entry; None for a recording without ticks."""
    axis: Array | None = None
    entered = np.full((len(scene.membranes), 3), np.nan)
    for batch in recording.batches():
        ticks = ticks_of(batch)
        if len(ticks) == 0:
            continue
        axis = np.asarray(ticks.axis[0], np.float64) if axis is None else axis
        for i in range(min(len(entered), ticks.phase.shape[1])):
            inside = INSIDE[ticks.phase[:, i]]
            if np.isnan(entered[i]).any() and inside.any():
                entered[i] = ticks.direction[inside.argmax(), i]
        if np.isfinite(entered).all():
            break
    return None if axis is None else law_curves(scene, obliquities(scene, axis, entered))


def tick_frames(recording: Recording) -> Iterator[bytes]:
    """All ticks: per frame its length (u32), the frame, and zeros up to a multiple of 4 bytes."""
    lost, expected = 0, 0
    for batch in recording.batches():
        for start in range(0, len(batch), MOST_TICKS):
            ticks = ticks_of(batch.slice(start, MOST_TICKS))
            ticks = ticks.replace(phase=np.where(ticks.phase == ABSENT, np.uint8(Phase.outside.value), ticks.phase))
            for piece in _whole(ticks):
                first = int(piece.tick[0])
                lost += max(0, first - expected)
                expected = int(piece.tick[-1]) + 1
                frame = encode_ticks(piece, 0, lost)
                yield joined([frame])


def _whole(ticks: Ticks) -> Iterator[Ticks]:
    """Splits ticks into pieces of consecutive ticks."""
    breaks = np.flatnonzero(np.diff(ticks.tick.astype(np.int64)) != 1) + 1
    for start, end in itertools.pairwise([0, *(int(b) for b in breaks), len(ticks)]):
        yield ticks[start:end]


def motion_of(recording: Recording) -> tuple[Array, Array, Array]:
    """Time from 0 on (s), tip (m) and axis, at about MOTION_HZ. Raises ValueError if there is no motion."""
    step = max(1, round(recording.info.scene.servo.rate / MOTION_HZ))
    parts: list[list[Array]] = [[], [], []]
    at = 0
    for batch in recording.batches():
        ticks = ticks_of(batch)
        first = -at % step
        for part, name in zip(parts, ("time", "tip", "axis"), strict=True):
            part.append(ticks[name][first::step].astype(np.float64))
        at += len(batch)
    time, tip, axis = (np.concatenate(part) if part else np.empty(0) for part in parts)
    good = np.isfinite(time) & np.isfinite(tip).all(axis=-1) if len(time) else np.zeros(0, bool)
    if not good.any():
        raise ValueError("the recording has no motion")
    time, tip, axis = time[good], tip[good], axis[good]
    return time - time[0], tip, axis


class RecordingTrace(Part):
    """A drawing of a recording. None: a gap."""

    time: list[Finite]  # s, of the run
    depth: list[Finite | None]  # m, of the point below the first surface
    force: list[Finite | None]  # N, size of the model's total force, negative if it pulls the needle in
    tip: Finite  # m, how far the end of the slanted face is above the point, along the first membrane's normal
    membranes: list[MembraneView]


def thinned_trace(
    recording: Recording, start: float = 0.0, points: int = USUAL, before: int | None = None
) -> RecordingTrace:
    """The trace from `start` (s of the run) on. The maximum of its force is an exercise's `peak_force`. Raises
    RecordingError.

    before: the depth as it is judged in an exercise whose space is behind this membrane; else that of the device's tip.

    Each bucket of ticks keeps its first and last row, and those of the lowest and highest depth and force. A bucket
    ends at each of the first MOST_EVENTS events. A row of nulls breaks the curves at lost ticks.
    """
    info = recording.info
    rate = info.scene.servo.rate
    skipped = max(0.0, start * rate - float(recording.summary.first_tick))
    size = max(1, math.ceil(max(recording.rows - skipped, 1.0) * EACH / points))
    thin = _Thinner(size)
    judge = _Judge(info.scene, before)
    kept = [thin.add(*part) for part in _rows(recording, start, judge)]
    rows = np.concatenate([*kept, thin.end()])
    return RecordingTrace(
        time=rows[:, 0].round(5).tolist(),
        depth=_rounded(rows[:, 1], 7),
        force=_rounded(rows[:, 2], 5),
        tip=judge.tip,
        membranes=membrane_views(info.scene),
    )


def _rounded(values: Array, digits: int) -> list[float | None]:
    return [None if np.isnan(v) else round(float(v), digits) for v in values]


def _rows(recording: Recording, start: float, judge: _Judge) -> Iterator[tuple[Array, npt.NDArray[np.bool_]]]:
    """Batches (n, 3) of time, depth and force, and the rows that end a bucket: at and before an event, and at gaps."""
    events = 0
    next_tick: int | None = None
    for columns, found_here in recorded_events(recording):
        found = [event.tick for event in found_here][: MOST_EVENTS - events]
        events += len(found)
        tick = columns["tick"].astype(np.int64)
        rows = np.stack([columns["time"].astype(np.float64), *judge.drawn(columns)], axis=1)
        keep = np.isin(tick, found) | np.isin(tick + 1, found)
        gaps = np.flatnonzero(np.diff(tick, prepend=tick[0] - 1 if next_tick is None else next_tick - 1) != 1)
        next_tick = int(tick[-1]) + 1
        breaks = np.column_stack([rows[gaps, 0], np.full((len(gaps), 2), np.nan)])
        rows, keep = np.insert(rows, gaps, breaks, axis=0), np.insert(keep, gaps, True)
        late = rows[:, 0] >= start
        if late.any():
            yield rows[late], keep[late]


class _Judge:
    """Depth and force of ticks, for a drawing."""

    def __init__(self, scene: Scene, before: int | None) -> None:
        self._scene, self._geometry = scene, Geometry(scene)
        parallel = (self._geometry.normals @ self._geometry.normals[0] > PARALLEL).all()
        self._before = before if before is not None and before < len(scene.membranes) and parallel else None
        self.tip = 0.0

    def drawn(self, columns: Columns) -> tuple[Array, Array]:
        geometry, force = self._geometry, resistance(columns["model_force"], columns["axis"])
        if self._before is None:
            return (columns["tip"] - np.asarray(self._scene.membranes[0].point)) @ geometry.normals[0], force
        ticks = geometry.ticks(columns)
        inside = ticks.inside[:, self._before]
        if self.tip == 0.0 and inside.any():
            row = int(inside.argmax())
            self.tip = float(ticks.past[row, self._before] - ticks.tip_past[row, self._before])
        return judged_depth(self._scene, geometry, ticks, self._before), force


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
