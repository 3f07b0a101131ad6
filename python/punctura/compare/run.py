"""One run to compare: the few columns that a comparison needs, for each tick."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from punctura import Scene, Ticks
from punctura.events import Event, EventFinder
from punctura.events.finder import recorded_events
from punctura.record import Recording, open_recording

Array = npt.NDArray[np.float64]
MOST_TICKS = 2_000_000  # of a recording: 20 minutes at 1600 Hz need 400 MB


@dataclass
class Run:
    """A run, n ticks of m membranes. SI. Forces on the hand are positive if they push the needle out."""

    name: str  # for tables and pictures
    scene: Scene  # at the start of the run
    events: Sequence[Event]  # touches, pops and exits, by time
    time: Array = field(repr=False)  # (n,), s of the run
    depth: Array = field(repr=False)  # (n,), of the tip below the first surface, m
    travel: Array = field(repr=False)  # (n,), of the tip along the needle since the tick before, m; positive inwards
    axis: Array = field(repr=False)  # (n, 3), direction of the needle
    model: Array = field(repr=False)  # (n,), size of the model's force, N
    felt: Array = field(repr=False)  # (n,), size of the device's force, N; NaN without a device
    model_along: Array = field(repr=False)  # (n,), the model's force along the needle, N
    felt_along: Array = field(repr=False)  # (n,), the device's force along the needle, N; NaN without a device
    force_limit: Array = field(repr=False)  # (n,), the most that the limits allow, N; NaN without a device
    depths: Array = field(repr=False)  # (n, m), of the tip in each membrane, m
    forces: Array = field(repr=False)  # (n, m), the model's resistance of each membrane along the needle, N
    # Of the syringe's plunger, (n,); NaN without a syringe.
    thumb: Array = field(repr=False)  # the model's force of the thumb, N; positive if it pushes
    pressure: Array = field(repr=False)  # Pa
    plunger: Array = field(repr=False)  # m, from where it starts
    has_law: bool = field(default=True, kw_only=True)  # of the scene; with a rival's force no pop is known

    @property
    def touch(self) -> int:
        """The row of the first contact with a membrane; 0 if there is none."""
        first = next((event for event in self.events if event.what == "touch"), None)
        return 0 if first is None else min(int(np.searchsorted(self.time, first.time)), len(self.time) - 1)

    @property
    def out(self) -> int:
        """The row after the first insertion: the needle has left the membrane that it touched first."""
        first = next((event for event in self.events if event.what == "touch"), None)
        if first is None:
            return len(self.time)
        left = (e for e in self.events if e.what == "out" and e.membrane == first.membrane and e.time > first.time)
        end = next(left, None)
        return len(self.time) if end is None else int(np.searchsorted(self.time, end.time)) + 1

    @classmethod
    def of_ticks(cls, name: str, scene: Scene, ticks: Ticks) -> Run:
        """A run of ticks in memory, such as those of `punctura.simulate`. Raises ValueError if there is none."""
        return _joined(name, scene, [(ticks, EventFinder(scene).add(ticks))])


def recorded_run(recording: Recording | str | os.PathLike[str], name: str = "") -> Run:
    """Reads a recording as a run; a rival's name stands behind its own.

    Raises RecordingError, ValueError if it has no ticks.
    """
    opened = recording if isinstance(recording, Recording) else open_recording(recording)
    rivals = " and ".join(rival.name for rival in opened.info.rivals)
    named = f"{name or opened.path.stem}{rivals and f' ({rivals})'}"
    return _joined(named, opened.info.scene, recorded_events(opened), has_law=not rivals)


def _joined(name: str, scene: Scene, parts: Iterable[tuple[Ticks, list[Event]]], has_law: bool = True) -> Run:
    first = scene.membranes[0]
    normal = np.asarray(first.inward_normal, np.float64) / np.linalg.norm(first.inward_normal)
    members = len(scene.membranes)
    events: list[Event] = []
    rows: list[list[Array]] = []
    tips, axes = [], []
    for ticks, new in parts:
        if not len(ticks):
            continue
        events += new
        tip = ticks.tip if "tip" in ticks else ticks.position
        tips.append(np.asarray(tip, np.float64))
        axes.append(np.asarray(ticks.axis, np.float64))
        model = ticks.model_force if "model_force" in ticks else ticks.force
        force_limit = ticks.get("ceiling")  # only a device has one
        none = np.full(len(ticks), np.nan)
        rows.append(
            [
                np.asarray(ticks.time, np.float64),
                (tips[-1] - np.asarray(first.point)) @ normal,
                resistance(model, ticks.axis),
                none if force_limit is None else resistance(ticks.force, ticks.axis),
                -np.einsum("ij,ij->i", model, ticks.axis),
                none if force_limit is None else -np.einsum("ij,ij->i", ticks.force, ticks.axis),
                none if force_limit is None else np.asarray(force_limit, np.float64),
                np.asarray(ticks.depth, np.float64).reshape(len(ticks), -1)[:, :members],
                -np.asarray(ticks.axial_force, np.float64).reshape(len(ticks), -1)[:, :members],
                -np.asarray(ticks.get("thumb_force", none), np.float64),
                np.asarray(ticks.get("pressure", none), np.float64),
                np.asarray(ticks.get("plunger", none), np.float64),
            ]
        )
    if not rows:
        raise ValueError(f"{name} has no ticks")
    time, depth, *found = (np.concatenate(part) for part in zip(*rows, strict=True))
    tip, axis = np.concatenate(tips), np.concatenate(axes)
    steps = np.diff(tip, axis=0, prepend=tip[:1])
    travel = np.einsum("ij,ij->i", steps, axis)
    return Run(name, scene, events, time, depth, travel, axis, *found, has_law=has_law)


def resistance(force: Array, axis: Array) -> Array:
    """The size of a force (n, 3), N, negative if it pulls the needle in. axis (n, 3): direction of the needle."""
    size = np.linalg.norm(force, axis=1)
    signed: Array = np.where(np.einsum("ij,ij->i", force, axis) > 0, -size, size)
    return signed
