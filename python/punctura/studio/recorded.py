"""A recording for the page: its scene, its events, and its ticks in the frames of a live run."""

from __future__ import annotations

import itertools
import struct
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from punctura import Phase, Scene
from punctura._core import force_scale
from punctura.errors import ConfigurationError
from punctura.events import find_events
from punctura.record import Recording
from punctura.record.columns import ticks_of
from punctura.studio.loaded import Loaded, from_tables, from_text
from punctura.studio.pump import MOST_TICKS
from punctura.studio.view import law_curves, obliquities, scene_view
from punctura.studio.wire.common import LawCurve, Part, SceneView
from punctura.studio.wire.frames import encode_ticks
from punctura.studio.wire.messages import MembraneEvent
from punctura.ticks import ABSENT, INSIDE, Ticks

MOTION_HZ = 250.0  # sampling rate of a recorded motion for the hand; Target smooths between the samples
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
        events=[MembraneEvent(**dict(event)) for event in find_events(recording)],
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
                yield struct.pack("<I", len(frame)) + frame + bytes(-len(frame) % 4)


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
