"""The needles of one MjData: their models, the tick that MuJoCo has not made yet, and their saved state."""

from __future__ import annotations

import copy
import json
import zlib
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from punctura import Insertion, Phase, Scene
from punctura.mujoco.implicit import Applied, solve
from punctura.mujoco.kinematics import Array, Link, Relative

_HOLDING = (Phase.sticking, Phase.sliding_in, Phase.sliding_out)


class Tick(NamedTuple):
    """One tick of all L pairs of a needle and a body, in the frames of the bodies that carry the membranes."""

    time: float  # s, the start of the step
    tip: Array  # (L, 3) m; with the implicit force as it was expected for the end of the step
    axis: Array  # (L, 3)
    force: Array  # (L, 3) N, on the needles


def _steepest(scene: Scene) -> float:
    """K + B/T, with all relaxation branches, of all membranes that can hold the needle, N/m."""
    coupling = scene.coupling
    one = coupling.stiffness + sum(branch.stiffness for branch in scene.relaxation)
    return len(scene.membranes) * (one + coupling.damping * scene.servo.rate)


class Needles:
    """One Insertion a link, and the last tick."""

    def __init__(self, links: Sequence[Link], period: float) -> None:
        self._links, self._period = links, period
        self.applied = Applied([(link.holder, link.body) for link in links])
        self._stages = 0  # of RK4, inside the pending step
        self.insertions: list[Insertion] = [copy.copy(link.insertion) for link in links]
        self.pending: Tick | None = None  # the tick of the step that MuJoCo is making
        self.last: Tick | None = None  # the last tick that was made
        self.steepest = max(_steepest(insertion.scene) for insertion in self.insertions)

    @property
    def force(self) -> Array:
        """(L, 3) N: of the last tick that was made; 0 before the first."""
        return self.last.force if self.last else np.zeros((len(self.insertions), 3))

    def holds(self, i: int) -> bool:
        """Whether a membrane holds the needle of link i."""
        return any(phase in _HOLDING for phase in self.insertions[i].phases)

    def ahead(self, time: float, free: Array, seen: Relative, compliance: Array) -> Tick:
        """The tick of a step that begins at `time`, from the last one that was made. Makes no tick.

        free (L, 3): where the tips will be at the end of the step without these forces, m. compliance (3 L, 3 L): how
        far a force moves them until then, m/N.
        """
        if self.last is None:  # the needles begin where they are now, not where the first step ends
            self.insertions = [copy.copy(link.insertion) for link in self._links]
            self._step(seen.tip, seen.axis)

        def respond(tips: Array) -> Array:
            given = zip(self.insertions, tips, seen.axis, strict=True)
            return np.array([insertion.peek(tip, axis) for insertion, tip, axis in given])

        tip, force = solve(respond, free, compliance, self.force, self.steepest)
        return Tick(time, tip, seen.axis, force)

    def in_stage(self, time: float) -> bool:
        """Whether this call is a later stage of RK4 in the pending step: two in its middle and one at its end."""
        if self.pending is None:
            return False
        share = (time - self.pending.time) / self._period
        stage = 0.25 < share < 0.75 or (self._stages == 2 and share < 1.25)
        self._stages = self._stages + 1 if stage else 0
        return stage

    def end_step(self, time: float) -> None:
        """Makes the pending tick if its step has ended. Otherwise the step was not made, and is forgotten."""
        pending, self.pending, self._stages = self.pending, None, 0
        if pending is not None and time - pending.time > 0.75 * self._period:
            self._step(pending.tip, pending.axis)
            self.last = pending

    def _step(self, tips: Array, axes: Array) -> None:
        for insertion, tip, axis in zip(self.insertions, tips, axes, strict=True):
            insertion.step(tip, axis)


_NAME = "punctura.mujoco"
_FORMAT = 1
_TICKS = ("last", "pending")


def pack(mujoco: Any, model: Any, data: Any, needles: Needles) -> bytes:
    """A line of JSON that describes the parts, then the parts."""
    physics = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_INTEGRATION))
    mujoco.mj_getState(model, data, physics, mujoco.mjtState.mjSTATE_INTEGRATION)
    parts = [physics.tobytes(), *(insertion.state for insertion in needles.insertions)]
    parts += [_tick_bytes(getattr(needles, name)) for name in _TICKS]
    body = b"".join(parts)
    head = {
        "what": _NAME, "format": _FORMAT, "model": int(model.signature), "sizes": [len(part) for part in parts],
        "checksum": zlib.crc32(body),
    }  # fmt: skip
    return json.dumps(head).encode() + b"\n" + body


def unpack(mujoco: Any, model: Any, state: bytes, into: Needles) -> Array:
    """Sets the new needles `into` and returns the state for mj_setState. Raises ValueError for other bytes."""
    head_bytes, _, body = bytes(state).partition(b"\n")
    try:
        head = json.loads(head_bytes)
        known = head["what"] == _NAME and head["format"] == _FORMAT
        sizes, checksum, signature = [int(size) for size in head["sizes"]], head["checksum"], head["model"]
    except (ValueError, KeyError, TypeError):
        known = False
    if not known:
        raise ValueError("these bytes are no state of save(), or of another version of punctura")
    if sum(sizes) != len(body) or zlib.crc32(body) != checksum:
        raise ValueError(f"this state is damaged: it has {len(body)} bytes, and was saved with {sum(sizes)}")
    size = mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_INTEGRATION)
    if signature != int(model.signature) or len(sizes) != 3 + len(into.insertions) or sizes[0] != 8 * size:
        raise ValueError("this state belongs to another model or to other needles: restore it where it was saved")
    parts, begin = [], 0
    for length in sizes:
        parts.append(body[begin : begin + length])
        begin += length
    for insertion, part in zip(into.insertions, parts[1:-2], strict=True):
        insertion.state = part
    for name, part in zip(_TICKS, parts[-2:], strict=True):
        setattr(into, name, _tick(part, len(into.insertions)))
    return np.frombuffer(parts[0])


def _tick_bytes(tick: Tick | None) -> bytes:
    return np.concatenate([np.ravel(part) for part in tick]).tobytes() if tick else b""


def _tick(part: bytes, links: int) -> Tick | None:
    if not part:
        return None
    numbers = np.frombuffer(part)
    if numbers.size != 1 + 9 * links or not np.isfinite(numbers).all():
        raise ValueError("this state belongs to another model or to other needles: restore it where it was saved")
    tip, axis, force = numbers[1:].reshape(3, links, 3)
    return Tick(float(numbers[0]), tip, axis, force)
