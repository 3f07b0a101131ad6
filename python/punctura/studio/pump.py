"""Sends every tick of a run to the pages, in frames without gaps, sixty times per second."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator
from typing import Protocol

import numpy as np
from pydantic import BaseModel

from punctura import Phase, Scene
from punctura._core import Fault
from punctura.defects import explain
from punctura.events import EventFinder
from punctura.studio.followers import Estimator, OtherSolver
from punctura.studio.health import fault_words
from punctura.studio.run import Run
from punctura.studio.view import TURN, Vector, law_curves, obliquities
from punctura.studio.wire.common import LawCurve
from punctura.studio.wire.frames import encode_ticks
from punctura.studio.wire.messages import FaultMessage, LawsMessage, MembraneEvent, Notice
from punctura.ticks import COMMAND_SCENE, FIELDS, Ticks
from punctura.ticks.files import CsvOutput

MOST_TICKS = 4096  # in one frame
LAWS_EVERY_S = 0.1


class Publisher(Protocol):
    """Sends frames and messages to the pages. Called from the worker's thread."""

    def frame(self, data: bytes) -> None: ...

    def send(self, message: BaseModel) -> None: ...


class Pump:
    """The pump of one run. It keeps its state from batch to batch."""

    def __init__(self, run: Run, out: Publisher, kept: KeptTicks | None = None) -> None:
        """kept: gets the ticks before a fault."""
        self._run, self._out, self._kept = run, out, kept or KeptTicks()
        self._next_tick = 0
        self._gaps = 0  # lost ticks
        self._fault = 0
        self._finder = EventFinder(run.loop.scene, run.rate)
        self._other: OtherSolver | None = None
        self._estimator: Estimator | None = None
        self._on_scene: Callable[[], None] | None = None  # called when a tick has taken the new scene
        self._axis: Vector = np.array(run.pose[1])
        self._entered: Vector | None = None
        self._angles = np.full(len(run.loop.scene.membranes), np.nan)
        self._laws_at = 0.0  # time of the run from which the laws may be sent again, s

    @property
    def lost(self) -> int:
        return self._gaps

    def turn(self, most: int | None = None) -> Ticks | None:
        """Sends and returns the ticks that the ring holds, at most so many; None if it holds none."""
        ticks = self._run.read(most)
        if len(ticks) == 0:
            return None
        for part in _parts(ticks):
            if int(part.commands[0]) & COMMAND_SCENE:
                self._scene_is_taken()
            self._send(part)
        self._watch_fault(ticks)
        self._watch_axis(ticks)
        for event in self._finder.add(ticks):
            self._out.send(MembraneEvent(**event.model_dump()))
        if self._estimator and (estimate := self._estimator.add(ticks)):
            self._out.send(estimate)
        return ticks

    def change(self, scene: Scene, on_change: Callable[[], None]) -> Ticks | None:
        """Call it after an exchange of scenes. It calls `on_change` between the ticks of the old and the new scene."""
        self._finder.change(scene)
        self._on_scene = on_change
        ticks = self.turn()
        self._scene_is_taken()  # needed if no further tick comes
        return ticks

    def compare(self, on: bool) -> None:
        """Turns the comparison with the other solver on or off."""
        self._other = OtherSolver(self._run.loop.scene) if on else None

    def estimate(self, on: bool) -> None:
        """Turns the live estimate on or off."""
        self._estimator = Estimator(self._run.loop.scene, self._run.rate) if on else None

    def laws(self) -> list[LawCurve]:
        """The laws of the present scene, for the present direction of the needle."""
        scene = self._run.loop.scene
        self._angles = obliquities(scene, self._axis, self._entered)
        return law_curves(scene, self._angles)

    def _scene_is_taken(self) -> None:
        on_change, self._on_scene = self._on_scene, None
        if on_change is not None:
            on_change()
            if self._other:
                self._other.take(self._run.loop.scene)
            if self._estimator:
                self._estimator.change(self._run.loop.scene)

    def _send(self, part: Ticks) -> None:
        first = int(part.tick[0])
        self._gaps += first - self._next_tick
        self._next_tick = int(part.tick[-1]) + 1
        other = self._other.run(part) if self._other else None
        self._out.frame(encode_ticks(part, self._run.number, self._gaps, other))

    def _watch_fault(self, ticks: Ticks) -> None:
        fault = int(ticks.fault[-1])
        if fault == self._fault:
            return
        self._fault = fault
        if fault == 0:
            self._out.send(no_fault())
            return
        kind = Fault(fault)
        began = int(np.flatnonzero(ticks.fault == fault)[0])
        happened, remedy = fault_words(kind)
        trouble, thumb = self._run.loop.device.trouble(), self._run.thumb if kind is Fault.thumb else None
        if thumb is not None:  # one that sends nothing has no fault of its own
            trouble = thumb.device.trouble() or trouble
            if thumb.fault != Fault.none:
                what, remedy = fault_words(thumb.fault)
                happened = f"The device under the thumb has a fault. {what}"
        self._out.send(
            FaultMessage(
                fault=kind.name,
                reason=happened,
                remedy=remedy,
                trouble=trouble,
                tick=int(ticks.tick[began]),
                kept=self._kept.keep(self._run.loop.fault_history()),
            )
        )

    def _watch_axis(self, ticks: Ticks) -> None:
        now, axis = float(ticks.time[-1]), ticks.axis[-1]
        if np.isfinite(axis).all():
            inside = ticks.phase[-1] != Phase.outside.value
            self._axis, self._entered = axis, np.where(inside[:, None], ticks.direction[-1], np.nan)
        scene = self._run.loop.scene
        if now < self._laws_at or len(self._angles) != len(scene.membranes):
            return
        angles = obliquities(scene, self._axis, self._entered)
        if not np.abs(angles - self._angles).max() <= TURN:  # NaN: nothing was sent yet
            self._laws_at = now + LAWS_EVERY_S
            self._out.send(LawsMessage(laws=self.laws()))


def no_fault() -> FaultMessage:
    return FaultMessage(fault="none", reason="", remedy="", trouble="", tick=None, kept=0)


def _parts(ticks: Ticks) -> Iterator[Ticks]:
    """Splits a batch at gaps, at new scenes, and after MOST_TICKS."""
    tick = ticks.tick.astype(np.int64)
    n = len(tick)
    breaks = {int(b) + 1 for b in np.flatnonzero(np.diff(tick) != 1)}
    breaks |= {int(b) for b in np.flatnonzero(ticks.commands & COMMAND_SCENE)}
    starts = sorted({0} | breaks)
    for start, end in zip(starts, [*starts[1:], n], strict=True):
        for at in range(start, end, MOST_TICKS):
            yield _without_absent(ticks[at : min(end, at + MOST_TICKS)])


def _without_absent(piece: Ticks) -> Ticks:
    """Removes the columns of membranes that this piece's scene does not have; they are the last ones."""
    count = int((~np.isnan(piece.depth[0])).sum())
    if count == piece.membrane_count:
        return piece
    return piece.replace(**{name: piece[name][:, :count] for name in piece if FIELDS[name].per_membrane})


class KeptTicks:
    """The worker writes, any thread reads. They stay until the next fault, also after a reset and in other runs."""

    def __init__(self) -> None:
        self._ticks: Ticks | None = None

    def keep(self, ticks: Ticks) -> int:
        """Returns the number of ticks. No ticks leave the earlier ones."""
        if len(ticks):
            self._ticks = ticks
        return len(ticks)

    def csv(self) -> tuple[str, bytes] | None:
        """A name for the file, and its bytes; None if there was no fault."""
        ticks = self._ticks
        if ticks is None:
            return None
        table, out = ticks.to_arrow(), io.BytesIO()
        CsvOutput(out, table.schema).write(table)
        return f"fault-at-tick-{int(ticks.tick[-1])}.csv", out.getvalue()


class Defects:
    """Tells each defect once, not sixty times a second."""

    def __init__(self, out: Publisher) -> None:
        self._out = out
        self._last = ""

    def guard(self, step: Callable[[], object]) -> None:
        """Calls `step`; if it raises, the pages get a notice."""
        try:
            step()
        except Exception as error:
            text = explain(error)
            if text != self._last:
                self._last = text
                self._out.send(Notice(text=text))
