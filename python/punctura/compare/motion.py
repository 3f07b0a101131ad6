"""Motions for runs without a hand, a ready stroke or that of a recording; and runs that differ in one parameter."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from punctura import ConfigurationError, Scene, simulate
from punctura.compare.run import MOST_TICKS, Array, Run
from punctura.events.finder import recorded_ticks
from punctura.live import stroke_ends
from punctura.record import Recording

LONGEST_S = 120.0  # of a motion
SLOWEST, FASTEST = 1e-4, 0.5  # m/s, of a stroke


@dataclass
class Motion:
    """The motion of the needle's tip, as the device reports it."""

    name: str  # for tables and pictures
    time: Array = field(repr=False)  # (n,), s, from 0 on
    position: Array = field(repr=False)  # (n, 3), m
    axis: Array = field(repr=False)  # (n, 3) or (3,), direction of the needle

    @property
    def seconds(self) -> float:
        """Its length, s."""
        return float(self.time[-1]) if len(self.time) else 0.0


def stroke(scene: Scene, speed: float = 5e-3) -> Motion:
    """One stroke through all membranes and back, along the first normal, with a constant speed, m/s.

    Raises ValueError for a speed out of bounds, or a stroke that takes more than LONGEST_S.
    """
    if not SLOWEST <= speed <= FASTEST:
        raise ValueError(f"speed must be from {SLOWEST:g} to {FASTEST:g} m/s, not {speed:g}")
    start, end = (np.asarray(place) for place in stroke_ends(scene))
    way = float(np.linalg.norm(end - start))
    rate = scene.servo.rate
    if 2 * way / speed > LONGEST_S:
        raise ValueError(f"a stroke of {2 * way * 1e3:.1f} mm at {speed * 1e3:g} mm/s takes more than {LONGEST_S:g} s")
    time = np.arange(0.0, 2 * way / speed, 1 / rate)
    share = 1 - np.abs(1 - time * speed / way)
    position = start + share[:, None] * (end - start)
    return Motion(f"stroke at {speed * 1e3:g} mm/s", time, position, (end - start) / way)


def recorded_motion(recording: Recording) -> Motion:
    """The motion of a recording, every tick of it. Raises ValueError if there is none, or if it is too long."""
    name, rows = recording.path.stem, recording.rows
    too_long = f"{name} is longer than {LONGEST_S:g} s; choose a shorter recording"
    if rows > MOST_TICKS:
        raise ValueError(f"{name} has {rows} ticks; the limit is {MOST_TICKS}: choose a shorter recording")
    if (rows - 1) * recording.info.header.period_s > LONGEST_S * (1 + 1e-9):
        raise ValueError(too_long)
    parts: list[list[Array]] = [[], [], []]
    for ticks, _ in recorded_ticks(recording):
        good = np.isfinite(ticks.position).all(axis=1) & np.isfinite(ticks.axis).all(axis=1)
        for part, values in zip(parts, (ticks.time, ticks.position, ticks.axis), strict=True):
            part.append(np.asarray(values[good], np.float64))
    time, position, axis = (np.concatenate(part) if part else np.empty(0) for part in parts)
    if len(time) < 2:
        raise ValueError(f"{name} has no motion")
    if time[-1] - time[0] > LONGEST_S:
        raise ValueError(too_long)
    even = np.arange(time[0], time[-1], 1 / recording.info.scene.servo.rate)
    at = [np.stack([np.interp(even, time, values[:, k]) for k in range(3)], axis=1) for values in (position, axis)]
    return Motion(name, even - even[0], at[0], at[1])


MOST_RUNS = 25
MOST_SECONDS = 600.0  # of all runs together


class VaryError(ValueError):
    """A variation that is not possible; the text says why and what to do."""


def vary(scene: Scene, path: str, values: Sequence[float], motion: Motion | None = None) -> Iterator[Run]:
    """Yields a run for each value of a parameter (SI), all with the same motion; default: a stroke at 5 mm/s.

    path: of a field, as in `scene.fields()`. Raises VaryError before the first run; the scenes are checked, too.
    """
    motion = stroke(scene) if motion is None else motion
    if not 1 <= len(values) <= MOST_RUNS:
        raise VaryError(f"a variation has 1 to {MOST_RUNS} runs, not {len(values)}")
    if motion.seconds * len(values) > MOST_SECONDS:
        total = motion.seconds * len(values)
        raise VaryError(
            f"{len(values)} runs of {motion.seconds:.0f} s are {total:.0f} s; at most {MOST_SECONDS:g} s are "
            "simulated: take fewer values or a shorter motion"
        )
    fields = {one.path: one for one in scene.fields()}
    if path not in fields:
        raise VaryError(f"the scene has no field {path}; scene.fields() lists them")
    try:
        scenes = [scene.with_values({path: float(value)}) for value in values]
    except ConfigurationError as error:
        raise VaryError(str(error)) from None
    return _runs(scenes, path, fields[path].unit, values, motion)


def _runs(scenes: Sequence[Scene], path: str, unit: str, values: Sequence[float], motion: Motion) -> Iterator[Run]:
    for scene, value in zip(scenes, values, strict=True):
        ticks = simulate(scene, motion.position, time=motion.time, axis=motion.axis)
        full = np.broadcast_to(motion.axis, (len(motion.time), 3))
        if "axis" not in ticks:
            at = np.interp(ticks.time, motion.time, np.arange(len(motion.time)))
            ticks = ticks.replace(axis=full[np.round(at).astype(int)])
        yield Run.of_ticks(f"{path} = {value:g} {unit}".strip(), scene, ticks)
