"""Ticks as a binary frame, little-endian: a head of 40 bytes, then columns one after the other.

| bytes | type | what |
|---|---|---|
| 0 | u32 | magic, "PNT1" |
| 4 | u32 | n, ticks |
| 8 | u32 | m, membranes |
| 12 | u32 | flags: 1 the other solver's force is there |
| 16 | u64 | the first tick; the others follow it one by one |
| 24 | f64 | time of the first tick, s |
| 32 | u32 | the run, from 0 |
| 36 | u32 | snapshots lost before this frame in this run |
| 40 | f32 | columns of COLUMNS, each n by its width (m for those of each membrane), row by row |
| then | u8 | columns of BYTES, likewise |

Times are seconds after the first tick's, so that f32 keeps them to a nanosecond. What does not exist is NaN.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

MAGIC = 0x31544E50
HEAD = struct.Struct("<IIIIQdII")
OTHER_SOLVER = 1

# name -> width of a row; "m" counts once for each membrane.
COLUMNS: dict[str, tuple[int, bool]] = {
    "time": (1, False), "position": (3, False), "axis": (3, False), "tip": (3, False), "model_force": (3, False),
    "force": (3, False), "ceiling": (1, False),
    "depth": (1, True), "axial_force": (1, True), "lower": (1, True), "upper": (1, True), "proxy": (3, True),
    "direction": (3, True),
}  # fmt: skip
OTHER = "other_force"  # (n, 3), only with the flag
# name -> one for each membrane
BYTES: dict[str, bool] = {"state": False, "fault": False, "limit": False, "phase": True}

Columns = dict[str, npt.NDArray[Any]]


class FrameError(ValueError):
    """Bytes that are no frame of ticks."""


@dataclass(frozen=True)
class Ticks:
    """A frame as it was read: `columns` (n,), (n, 3), (n, m) or (n, m, 3), float32 and uint8."""

    first_tick: int
    first_time: float
    run: int
    lost: int
    membranes: int
    columns: Columns

    def __len__(self) -> int:
        return len(self.columns["time"])


def encode_ticks(columns: Columns, run: int, lost: int = 0, other_force: npt.NDArray[Any] | None = None) -> bytes:
    """The frame of a Listener's columns; their ticks must follow one another. Raises FrameError where they do not."""
    tick = columns["tick"]
    n = len(tick)
    if n == 0 or int(tick[-1]) - int(tick[0]) != n - 1:
        raise FrameError("a frame holds at least one tick, and no gap")
    m = columns["depth"].shape[1]
    flags = 0 if other_force is None else OTHER_SOLVER
    first = float(columns["time"][0])
    parts = [HEAD.pack(MAGIC, n, m, flags, int(tick[0]), first, run, lost)]
    for name in COLUMNS:
        values = columns[name] - first if name == "time" else columns[name]
        parts.append(np.ascontiguousarray(values, "<f4").tobytes())
    if other_force is not None:
        parts.append(np.ascontiguousarray(other_force, "<f4").tobytes())
    parts += [np.ascontiguousarray(columns[name], "u1").tobytes() for name in BYTES]
    return b"".join(parts)


def decode_ticks(frame: bytes) -> Ticks:
    """Raises FrameError."""
    if len(frame) < HEAD.size:
        raise FrameError(f"{len(frame)} bytes are too few for a frame")
    magic, n, m, flags, tick, time, run, lost = HEAD.unpack_from(frame)
    if magic != MAGIC:
        raise FrameError(f"begins with {magic:#x}, not with {MAGIC:#x}")
    columns: Columns = {}
    at = HEAD.size

    def take(name: str, kind: str, shape: tuple[int, ...]) -> None:
        nonlocal at
        count = int(np.prod(shape))
        size = count * np.dtype(kind).itemsize
        if at + size > len(frame):
            raise FrameError(f"ends within {name}")
        columns[name] = np.frombuffer(frame, kind, count, at).reshape(shape)
        at += size

    for name, (width, each) in COLUMNS.items():
        take(name, "<f4", (n, *((m,) if each else ()), *((width,) if width > 1 else ())))
    if flags & OTHER_SOLVER:
        take(OTHER, "<f4", (n, 3))
    for name, each in BYTES.items():
        take(name, "u1", (n, m) if each else (n,))
    if at != len(frame):
        raise FrameError(f"{len(frame) - at} bytes follow its end")
    return Ticks(tick, time, run, lost, m, columns)
