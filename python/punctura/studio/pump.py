"""From a run's ring to the pages: every tick, in frames without a gap, sixty times a second."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Protocol

import numpy as np
from pydantic import BaseModel

from punctura._core import Fault, describe
from punctura.studio.compare import OtherSolver
from punctura.studio.laws import TURN, law_curves, obliquities
from punctura.studio.run import Run
from punctura.studio.wire.frames import Columns, encode_ticks
from punctura.studio.wire.messages import FaultMessage, LawsMessage

COMMAND_SCENE = 8
MOST_TICKS = 4096  # in a frame
LAWS_EVERY_S = 0.1
PER_MEMBRANE = ("depth", "axial_force", "lower", "upper", "phase", "proxy", "direction")


class Publisher(Protocol):
    """Takes what is for the pages, from the worker's thread."""

    def frame(self, data: bytes) -> None: ...

    def say(self, message: BaseModel) -> None: ...


class Pump:
    """Of one run. Owns nothing but what it has to remember from batch to batch."""

    def __init__(self, run: Run, out: Publisher) -> None:
        self._run, self._out = run, out
        self._next_tick = 0
        self._gaps = 0  # ticks whose snapshot never came
        self._membranes = len(run.loop.scene.membranes)
        self._fault = 0
        self._angles = np.full(self._membranes, np.nan)
        self._laws_at = -1.0
        self._other: OtherSolver | None = None

    @property
    def lost(self) -> int:
        return self._gaps

    def turn(self) -> None:
        """Everything that the ring holds goes out."""
        columns = self._run.read()
        if len(columns["tick"]) == 0:
            return
        for part in _parts(columns, self._next_tick):
            self._send(part)
        self._watch_fault(columns)
        self._watch_axis(columns)

    def scene_changed(self) -> None:
        """After an exchange: what comes from the next turn on is of the new scene."""
        self._membranes = len(self._run.loop.scene.membranes)
        self._angles = np.full(self._membranes, np.nan)
        self._laws_at = -1.0
        if self._other:
            self._other.take(self._run.loop.scene)

    def compare(self, on: bool) -> None:
        """Whether the other solver runs beside."""
        self._other = OtherSolver(self._run.loop.scene) if on else None

    def _send(self, part: Columns) -> None:
        first = int(part["tick"][0])
        self._gaps += first - self._next_tick
        self._next_tick = int(part["tick"][-1]) + 1
        other = self._other.run(part) if self._other else None
        self._out.frame(encode_ticks(part, self._run.number, self._gaps, other))

    def _watch_fault(self, columns: Columns) -> None:
        fault = int(columns["fault"][-1])
        if fault == self._fault:
            return
        self._fault = fault
        if fault == 0:
            self._out.say(no_fault())
            return
        kind = Fault(fault)
        began = int(np.flatnonzero(columns["fault"] == fault)[0])
        self._out.say(
            FaultMessage(
                fault=kind.name,
                reason=describe(kind),
                trouble=self._run.loop.device.trouble(),
                tick=int(columns["tick"][began]),
                kept=len(self._run.loop.fault_history()["tick"]),
            )
        )

    def _watch_axis(self, columns: Columns) -> None:
        now = float(columns["time"][-1])
        if now < self._laws_at or columns["direction"].shape[1] != self._membranes:
            return
        axis = columns["axis"][-1]
        if not np.isfinite(axis).all():
            return
        scene = self._run.loop.scene
        angles = obliquities(scene, axis, columns["direction"][-1])
        if np.isnan(self._angles).any() or np.abs(angles - self._angles).max() > TURN:
            self._angles, self._laws_at = angles, now + LAWS_EVERY_S
            self._out.say(LawsMessage(laws=law_curves(scene, angles)))


def no_fault() -> FaultMessage:
    return FaultMessage(fault="none", reason="", trouble="", tick=None, kept=0)


def _parts(columns: dict[str, Any], next_tick: int) -> Iterator[Columns]:
    """The batch in pieces without a gap, of one scene each, and none too long."""
    tick = columns["tick"].astype(np.int64)
    n = len(tick)
    breaks = set(np.flatnonzero(np.diff(tick) != 1) + 1) | set(np.flatnonzero(columns["commands"] & COMMAND_SCENE))
    starts = sorted({0} | {int(b) for b in breaks})
    for start, end in zip(starts, [*starts[1:], n], strict=True):
        for at in range(start, end, MOST_TICKS):
            piece = {name: column[at : min(end, at + MOST_TICKS)] for name, column in columns.items()}
            yield _without_absent(piece)


def _without_absent(piece: Columns) -> Columns:
    """Without the columns of membranes that the scene of this piece does not have."""
    there = ~np.isnan(piece["depth"][0])
    count = int(there.sum()) if not there.all() else len(there)
    if count == len(there) or there[count:].any():
        return piece
    return {name: column[:, :count] if name in PER_MEMBRANE else column for name, column in piece.items()}
