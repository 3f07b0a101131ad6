"""A needle that is moved by poses with times, as trackers and robots send them."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from punctura._core import Insertion, Phase, Scene

__all__ = ["PoseWarning", "PosedNeedle"]

Array = NDArray[np.float64]
# Of a period. A tick this close to a pose gets the pose itself. A double resolves seconds since 1970 to 0.24 us only.
_CLOSE = 1e-3
_LATEST = 1e11  # s: the year 5138, and a double resolves 15 us there. Seconds since 1970 in ms, us and ns are later
_MOST_GAP = 60.0  # s, of longest_gap
_LONGEST_HOLD = 3600.0  # s
_AT_ONE_TIME = 100  # poses: a clock with steps of 10 ms gives ten of a tracker of 1 kHz the same time


class PoseWarning(UserWarning):
    """A pose with a time that does not follow the last one."""


class PosedNeedle:
    """A needle through the membranes of a scene, moved by poses at any rate.

    Between two poses it makes all ticks of the scene's rate, on a straight line. A pose that comes after a later one is
    dropped. After a gap of more than `longest_gap` (s, up to 60), or if the time goes back by more, the needle starts
    anew: a needle that is then inside a membrane gets no force from it until it has been outside (docs/conventions.md,
    `barred`). notice: is called with a sentence about each start anew and about dropped poses; default: a PoseWarning.

    hold_last_pose: for senders that send only what changes. In a gap of up to an hour the needle stays at the last
    pose, and moves to the new one in the last `longest_gap`. Raises ValueError, TypeError.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        longest_gap: float = 0.25,
        hold_last_pose: bool = False,
        notice: Callable[[str], None] | None = None,
    ) -> None:
        if not (math.isfinite(longest_gap) and 0 < longest_gap <= _MOST_GAP):
            raise ValueError(f"longest_gap must be more than 0 and at most {_MOST_GAP:g} s, not {longest_gap}")
        self.insertion = Insertion(scene)
        self.longest_gap = float(longest_gap)
        self.hold_last_pose = hold_last_pose
        self.starts = 0
        self.dropped = 0  # poses that came after a later one
        self._notice = notice or _warn
        self._rate = scene.servo.rate
        self._stamp = math.nan  # of the last pose
        self._time = math.nan  # up to which ticks are made
        self._start = 0.0
        self._ticks = 0
        self._lone = 0  # poses one after the other that each began anew
        self._same = 0  # poses one after the other with the same time
        self._pose = np.zeros(6)
        self._force = np.zeros(3)

    def __repr__(self) -> str:
        return f"<PosedNeedle at {self._rate:g} Hz, started {self.starts} times, {self.dropped} poses dropped>"

    @property
    def force(self) -> Array:
        """The force on the needle after the last tick, N (3,)."""
        return self._force.copy()

    def move(self, time: float, position: ArrayLike, axis: ArrayLike) -> Array:
        """Makes all ticks up to `time`, s. Returns the force on the needle, N (3,).

        position (3,): of the tip, m. axis (3,): direction in which the needle points, of any length but 0. Raises
        ValueError if they are not finite, or for a time that cannot be in seconds, and then changes nothing.
        """
        pose = np.concatenate([_three("position", position), _three("axis", axis)])
        if not (np.isfinite(pose).all() and pose[3:].any() and math.isfinite(time)):
            raise ValueError(f"time, position and axis must be finite, and the axis not 0: {time}, {pose}")
        if abs(time) > _LATEST:
            raise ValueError(
                f"the time of a pose must be in seconds, and {time:g} is not: multiply ms by 1e-3, us by 1e-6, "
                "ns by 1e-9"
            )
        step, gap = time - self._stamp, self.longest_gap
        if -gap <= step < 0:
            self._drop(step)
            return self.force
        ahead = time - self._time  # less than 0 if hold() was called
        if ahead < -gap:  # the sender's clock stood still meanwhile: go on at its time, not when it has caught up
            self._start += ahead
            self._time, ahead = time, 0.0
        if ahead > gap and step > 0 and self.hold_last_pose and ahead <= _LONGEST_HOLD:
            self.hold(time - gap)
            ahead = gap
        if step >= 0 and ahead <= gap:
            self._advance(max(time, self._time), pose)
            self._follow(step)
        else:
            self._begin(time, pose, step)
        self._stamp = time
        return self.force

    def hold(self, time: float) -> Array:
        """Makes all ticks up to `time`, s, at the last pose: for a sender that sends only what changes.

        Returns the force on the needle, N (3,); 0 before the first pose. Raises ValueError for more than an hour.
        """
        if not time - self._time <= _LONGEST_HOLD and self.starts:
            raise ValueError(f"a pose can be held for {_LONGEST_HOLD:g} s, not up to {time} s from {self._time} s on")
        while self._time < time:
            self._advance(min(time, self._time + self.longest_gap), self._pose)
        return self.force

    def _advance(self, time: float, pose: Array) -> None:
        due = math.floor((time - self._start) * self._rate + _CLOSE) + 1
        ticks = self._start + np.arange(self._ticks, due) / self._rate
        share = (ticks - self._time) / max(time - self._time, 1e-12)
        last, next_ = _unit(self._pose), _unit(pose)  # otherwise the longer axis would weigh more
        poses = last + (next_ - last) * share[:, None]
        poses[(time - ticks) * self._rate < _CLOSE] = pose  # with all its bits
        self._make(time, pose, poses)

    def _make(self, time: float, pose: Array, poses: Array) -> None:
        if len(poses):
            self._force = self.insertion.run(poses[:, :3], poses[:, 3:]).force[-1]
            self._ticks += len(poses)
        self._time, self._pose = time, pose

    def _begin(self, time: float, pose: Array, step: float) -> None:
        """step: from the last pose, s; NaN for the first one."""
        self.insertion.reset()
        self._start, self._ticks, self._same = time, 0, 0
        self.starts += 1
        self._make(time, pose, pose[None, :])
        if math.isnan(step):
            return
        self._lone += 1
        if self._lone == 1:
            pairs = zip(self.insertion.scene.membranes, self.insertion.phases, strict=True)
            inside = ", ".join(repr(membrane.name) for membrane, phase in pairs if phase == Phase.barred)
            self._notice(
                f"the pose at {time:.6f} s comes {step:+.3g} s after the last one, and longest_gap is "
                f"{self.longest_gap:g} s: the needle starts anew (restart {self.starts - 1}) at "
                f"({', '.join(f'{x * 1e3:.2f}' for x in pose[:3])}) mm"
                + (f". It is inside {inside} and gets no force there until it has been outside" if inside else "")
                + ". A sender that sends only what changes needs hold_last_pose"
            )
        elif self._lone == 2:  # and no more of these, which could come with each pose
            advice = (
                f"Their times must be in seconds: {_in_seconds(step)}. Otherwise, take a larger longest_gap"
                if step > 0
                else "Give them in the order of their times"
            )
            self._notice(f"each pose starts the needle anew, {step:+.3g} s after the last one: no force. {advice}")

    def _follow(self, step: float) -> None:
        """Counts what does not move on."""
        self._lone = 0
        self._same = 0 if step > 0 else self._same + 1
        if self._same == _AT_ONE_TIME:
            self._notice(
                f"{_AT_ONE_TIME} poses have the time {self._time:.6f} s: the force stays as it is while the time "
                "stands still. Give each pose the time at which it was measured, s"
            )

    def _drop(self, step: float) -> None:
        self.dropped += 1
        if 10 ** math.floor(math.log10(self.dropped) + 1e-9) == self.dropped:  # the first, the tenth, ...
            self._notice(
                f"a pose is {-step * 1e3:.3g} ms older than the last one, at {self._stamp:.6f} s, and is dropped; "
                f"{self.dropped} of these so far"
            )


def _three(name: str, given: ArrayLike) -> Array:
    if np.size(given) != 3 or np.ma.is_masked(given) or np.iscomplexobj(given):
        raise ValueError(f"{name} must be three real numbers, not {given!r}")
    return np.asarray(given, float).reshape(3)


def _unit(pose: Array) -> Array:
    """The pose with an axis of length 1."""
    axis = pose[3:] / np.abs(pose[3:]).max()
    return np.concatenate([pose[:3], axis / np.linalg.norm(axis)])


def _in_seconds(size: float) -> str:
    """What to do about times in another unit. size: what they would be in s, if 0.1 ms to 1 s is right."""
    unit, factor = ("ms", 1e-3) if size < 1e3 else ("us", 1e-6) if size < 1e6 else ("ns", 1e-9)
    return f"they seem to be in {unit}, so multiply them by {factor:g}"


def _warn(text: str) -> None:
    warnings.warn(text, PoseWarning, stacklevel=4)
