"""Ticks as a binary frame, little-endian: a head of 40 bytes, then columns one after the other.

| bytes | type | what |
|---|---|---|
| 0 | u32 | magic, "PNT2" |
| 4 | u32 | n, ticks |
| 8 | u32 | m, membranes |
| 12 | u32 | flags: bit 1: the frame has the other solver's force |
| 16 | u64 | the first tick; the others follow it one by one |
| 24 | f64 | time of the first tick, s |
| 32 | u32 | the run, from 0 |
| 36 | u32 | snapshots lost before this frame in this run |
| 40 | f32 | the numbers of each field, n rows of its width (times m where each membrane has one), field by field |
| then | f32 | the other solver's force, n rows of 3, if the flag is set |
| then | u8 | the fields that are words, likewise |

The fields are those of core's table (docs/tick.md) that are marked for the page, in its order.
Times are seconds after the first tick's, so that f32 keeps them to a nanosecond. A missing value is NaN.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from punctura.ticks import FIELDS, Ticks
from punctura.ticks.fields import shape_of

MAGIC = 0x32544E50
HEAD = struct.Struct("<IIIIQdII")
OTHER_SOLVER = 1
SEVERAL = b"PNTS"  # a message that begins with it has several frames

_ON_PAGE = [field for field in FIELDS.values() if field.on_page]
NUMBERS = [field for field in _ON_PAGE if field.words is None]
WORDS = [field for field in _ON_PAGE if field.words is not None]
OTHER = "other_force"  # (n, 3), only with the flag


class FrameError(ValueError):
    """The bytes are not a frame of ticks."""


@dataclass(frozen=True)
class Frame:
    """A decoded frame."""

    first_tick: int
    first_time: float  # s
    run: int
    lost: int
    membranes: int
    ticks: Ticks  # with other_force (n, 3), N, where both solvers run; times are s after the first

    def __len__(self) -> int:
        return len(self.ticks)


def encode_ticks(ticks: Ticks, run: int, lost: int = 0, other_force: npt.NDArray[Any] | None = None) -> bytes:
    """Encodes consecutive ticks as a frame. Raises FrameError if they are not consecutive."""
    tick = ticks.tick
    n = len(tick)
    if n == 0 or (np.diff(tick.astype(np.int64)) != 1).any():
        raise FrameError("a frame holds at least one tick, and no gap")
    flags = 0 if other_force is None else OTHER_SOLVER
    first = float(ticks.time[0])
    parts = [HEAD.pack(MAGIC, n, ticks.membrane_count, flags, int(tick[0]), first, run, lost)]
    for field in NUMBERS:
        values = ticks.time - first if field.name == "time" else ticks[field.name]
        parts.append(np.ascontiguousarray(values, "<f4").tobytes())
    if other_force is not None:
        parts.append(np.ascontiguousarray(other_force, "<f4").tobytes())
    parts += [np.ascontiguousarray(ticks[field.name], "u1").tobytes() for field in WORDS]
    return b"".join(parts)


def joined(frames: Iterable[bytes]) -> bytes:
    """Of each frame its length (u32), the frame, and zeros up to a multiple of 4 bytes."""
    return b"".join(struct.pack("<I", len(frame)) + frame + bytes(-len(frame) % 4) for frame in frames)


def split(message: bytes) -> list[bytes]:
    """The frames of a message of the socket: one, or several behind SEVERAL, each with its length."""
    if not message.startswith(SEVERAL):
        return [message]
    frames, at = [], len(SEVERAL)
    while at < len(message):
        (size,) = struct.unpack_from("<I", message, at)
        frames.append(message[at + 4 : at + 4 + size])
        at += 4 + size + -size % 4
    return frames


def decode_ticks(frame: bytes) -> Frame:
    """Raises FrameError."""
    if len(frame) < HEAD.size:
        raise FrameError(f"{len(frame)} bytes are too few for a frame")
    magic, n, m, flags, tick, time, run, lost = HEAD.unpack_from(frame)
    if magic != MAGIC:
        raise FrameError(f"begins with {magic:#x}, not with {MAGIC:#x}")
    at = HEAD.size

    def take(name: str, kind: str, shape: tuple[int, ...]) -> npt.NDArray[Any]:
        nonlocal at
        count = int(np.prod(shape))
        size = count * np.dtype(kind).itemsize
        if at + size > len(frame):
            raise FrameError(f"ends within {name}")
        at += size
        return np.frombuffer(frame, kind, count, at - size).reshape(shape)

    columns = {field.name: take(field.name, "<f4", shape_of(field, n, m)) for field in NUMBERS}
    if flags & OTHER_SOLVER:
        columns[OTHER] = take(OTHER, "<f4", (n, 3))
    columns |= {field.name: take(field.name, "u1", shape_of(field, n, m)) for field in WORDS}
    if at != len(frame):
        raise FrameError(f"{len(frame) - at} bytes follow its end")
    return Frame(tick, time, run, lost, m, Ticks(columns))
