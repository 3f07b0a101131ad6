"""The state of an MjData and of its needles, as bytes."""

from __future__ import annotations

import json
import zlib
from typing import Any

import numpy as np

from punctura.mujoco.frames import Array
from punctura.mujoco.needles import Needles, Tick

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
