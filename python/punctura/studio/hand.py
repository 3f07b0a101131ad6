"""The simulated hand and thumb, and when the page that moves them was heard."""

from __future__ import annotations

import math
import time
from collections import deque
from typing import Literal

import numpy as np
import numpy.typing as npt

from punctura import Scene
from punctura._core import Device, ServoLoop, SimulatedDevice, resting_pose
from punctura.live import stroke_ends

__all__ = ["LEAD_S", "REST_SHARE", "Hand", "Mode", "Pose", "resting_pose"]

Mode = Literal["target", "strokes", "motion", "device"]
Triple = tuple[float, float, float]
Pose = tuple[Triple, Triple]  # position, m, and axis
Array = npt.NDArray[np.float64]

SCRIPT_PERIOD_S = 1 / 250  # between two targets of strokes or a motion; the simulated device smooths them
REST_SHARE = 0.15  # share of a stroke's period for which the hand rests at each end
LEAD_S = 1.0  # time in which the hand moves to the start of a motion
FARTHEST = 0.5  # m from the origin


class Hand:
    """Moves a simulated device. With any other device it does nothing, and `mode` is "device"."""

    def __init__(self) -> None:
        self._device: SimulatedDevice | None = None
        self.mode: Mode = "device"
        self._axis: Triple = (0.0, -1.0, 0.0)
        self._here: Array = np.zeros(3)
        self._pose: Pose = ((0.0, 0.0, 0.0), self._axis)
        self._began = 0.0
        self._next = math.inf
        self._strokes: tuple[Array, Array, float] | None = None
        self._motion: tuple[Array, Array, Array] | None = None  # time, position, axis

    def take(self, device: Device, pose: Pose) -> None:
        """Takes the device of a new run, at rest in this pose."""
        self._device = device if isinstance(device, SimulatedDevice) else None
        self.mode = "target" if self._device else "device"
        self._here, self._axis = np.array(pose[0]), pose[1]
        self._pose = pose
        self._next = math.inf

    @property
    def pose(self) -> Pose | None:
        """The last target; None while strokes or a motion move the hand. From any thread."""
        return self._pose if self.mode == "target" else None

    def target(self, position: list[float], axis: list[float], buttons: int = 0) -> None:
        """Sets position, m, and direction. Raises ValueError if they are not finite, too far, or of no length."""
        if self._device is None:
            return
        place, direction = np.array(position, float), np.array(axis, float)
        length = math.hypot(*direction)
        if not (np.isfinite(place).all() and math.hypot(*place) <= FARTHEST and 1e-6 < length < 1e6):
            raise ValueError("a target needs a position within half a metre and an axis of some length")
        self.mode, self._next = "target", math.inf
        self._go(place, direction / length, buttons)

    def strokes(self, scene: Scene, period: float, now: float) -> None:
        """Strokes through all membranes and back, along the first normal. period: of one stroke in and out, s."""
        start, end = stroke_ends(scene)
        self._strokes = (np.array(start), np.array(end), period)
        inward = np.array(scene.membranes[0].inward_normal)
        self._axis = _triple(inward / np.linalg.norm(inward))
        self.mode, self._began, self._next = "strokes", now, now

    def motion(self, time: Array, position: Array, axis: Array, now: float) -> None:
        """Follows samples: time (n,) from 0 on, s; position (n, 3), m; axis (n, 3)."""
        lead = np.linspace(0.0, LEAD_S, 50)
        way = self._here + _eased(lead / LEAD_S)[:, None] * (position[0] - self._here)
        self._motion = (
            np.concatenate((lead[:-1], LEAD_S + time)),
            np.concatenate((way[:-1], position)),
            np.concatenate((np.repeat(axis[:1], len(lead) - 1, axis=0), axis)),
        )
        self.mode, self._began, self._next = "motion", now, now

    @property
    def next_at(self) -> float:
        """When `drive` must be called, on the clock of `now`; infinity without strokes or motion."""
        return self._next

    def drive(self, now: float) -> None:
        """Sets the next target of strokes or a motion, if one is due."""
        if now < self._next or self._device is None:
            return
        self._next = now + SCRIPT_PERIOD_S
        since = now - self._began
        if self.mode == "strokes" and self._strokes:
            start, end, period = self._strokes
            self._go(start + _there_and_back(since / period) * (end - start), np.array(self._axis))
        elif self.mode == "motion" and self._motion:
            time, position, axis = self._motion
            at = np.array([np.interp(since, time, position[:, i]) for i in range(3)])
            way = np.array([np.interp(since, time, axis[:, i]) for i in range(3)])
            length = float(np.linalg.norm(way))
            self._go(at, way / length if length > 1e-6 else np.array(self._axis))
            if since >= time[-1]:
                self.mode, self._next = "target", math.inf

    def _go(self, place: Array, direction: Array, buttons: int = 0) -> None:
        assert self._device is not None
        self._here, self._axis = place, _triple(direction)
        self._pose = _triple(place), self._axis
        self._device.move_to(_triple(place))
        self._device.point(self._axis, buttons)


def _there_and_back(turns: float) -> float:
    """From 0 to 1 and back in one turn: minimum-jerk motion (Flash and Hogan 1985), with a rest at both ends."""
    u = turns % 1.0
    u = 2 * u if u < 0.5 else 2 - 2 * u
    return float(_eased(np.array((u - REST_SHARE) / (1 - 2 * REST_SHARE))))


def _eased(u: Array) -> Array:
    """Minimum-jerk motion from 0 to 1; at rest before and after."""
    u = np.clip(u, 0.0, 1.0)
    eased: Array = u * u * u * (10 + u * (-15 + 6 * u))
    return eased


def _triple(v: Array) -> Triple:
    return float(v[0]), float(v[1]), float(v[2])


HOLD_S = 1.0  # a page that still pushes says so more often


class SimulatedThumb:
    """Pushes with the force that the page last asked for, and lets go if the page falls silent."""

    def __init__(self) -> None:
        self._until = math.inf

    def push(self, loop: ServoLoop, force: float, now: float) -> None:
        """force: N, 0 to 15. now: s, on the clock of `turn`."""
        loop.push_plunger(force)
        self._until = now + HOLD_S if force > 0 else math.inf

    def turn(self, loop: ServoLoop, now: float) -> None:
        if now >= self._until:
            self.push(loop, 0.0, now)


KEPT = 4096  # words; a page sends at most some hundred a second


class Heard:
    """A page that says that it is awake is late when it is silent. One that never says so is never late."""

    def __init__(self) -> None:
        self._words: deque[float] = deque(maxlen=KEPT)  # time.monotonic()

    def forget(self) -> None:
        """A new run: its page must say first that it is awake."""
        self._words.clear()

    def hear(self, awake: bool = False) -> None:
        """From any thread: a word of the page. awake: it says that it is awake, and will go on to do so."""
        if awake or self._words:
            self._words.append(time.monotonic())

    def age(self, times: npt.NDArray[np.float64], now: float) -> npt.NDArray[np.float64]:
        """Time since the last word before each tick, s; 0 before the first word. times: of the ticks up to `now`, s."""
        words = np.array(list(self._words), np.float64)
        if len(words) == 0:
            return np.zeros(len(times))
        at = now - (times[-1] - times)
        last = np.searchsorted(words, at, side="right") - 1
        age: npt.NDArray[np.float64] = np.where(last >= 0, at - words[np.maximum(last, 0)], 0.0)
        return age
