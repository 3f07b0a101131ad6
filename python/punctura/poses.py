"""A needle that is moved by poses with times, as trackers and robots send them."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from punctura._core import Insertion, Scene

Array = NDArray[np.float64]
# Of a period. A tick this close to a pose gets the pose itself. A double resolves seconds since 1970 to 0.24 us only.
_CLOSE = 1e-3


class PosedNeedle:
    """A needle through the membranes of a scene, moved by poses at any rate.

    Between two poses it makes all ticks of the scene's rate, on a straight line. After a gap of more than
    `longest_gap` (s), or if the time goes back, it starts anew: a needle that is then inside a membrane gets no force
    from it until it has been outside (docs/conventions.md, `barred`).
    """

    def __init__(self, scene: Scene, *, longest_gap: float = 0.25) -> None:
        self.insertion = Insertion(scene)
        self.longest_gap = longest_gap
        self.starts = 0
        self._rate = scene.servo.rate
        self._time = math.nan
        self._start = 0.0
        self._ticks = 0
        self._pose = np.zeros(6)
        self._force = np.zeros(3)

    def __repr__(self) -> str:
        return f"<PosedNeedle at {self._rate:g} Hz, started {self.starts} times>"

    @property
    def force(self) -> Array:
        """The force on the needle after the last tick, N (3,)."""
        return self._force.copy()

    def move(self, time: float, position: ArrayLike, axis: ArrayLike) -> Array:
        """Makes all ticks up to `time`, s. Returns the force on the needle, N (3,).

        position (3,): of the tip, m. axis (3,): direction in which the needle points, of any length but 0. Raises
        ValueError if they are not finite, and then changes nothing.
        """
        pose = np.concatenate([np.asarray(position, float).reshape(3), np.asarray(axis, float).reshape(3)])
        if not (np.isfinite(pose).all() and pose[3:].any() and math.isfinite(time)):
            raise ValueError(f"time, position and axis must be finite, and the axis not 0: {time}, {pose}")
        if not 0 <= time - self._time <= self.longest_gap:
            self._begin(time)
            poses = pose[None, :]
        else:
            poses = self._between(time, pose)
        if len(poses):
            self._force = self.insertion.run(poses[:, :3], poses[:, 3:]).force[-1]
            self._ticks += len(poses)
        self._time, self._pose = time, pose
        return self.force

    def _begin(self, time: float) -> None:
        self.insertion.reset()
        self._start, self._ticks = time, 0
        self.starts += 1

    def _between(self, time: float, pose: Array) -> Array:
        due = math.floor((time - self._start) * self._rate + _CLOSE) + 1
        ticks = self._start + np.arange(self._ticks, due) / self._rate
        share = (ticks - self._time) / max(time - self._time, 1e-12)
        poses = self._pose + (pose - self._pose) * share[:, None]
        poses[(time - ticks) * self._rate < _CLOSE] = pose  # with all its bits
        return np.asarray(poses, float)
