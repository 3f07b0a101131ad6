"""Judges how far the tip moves on after a membrane gives way, in a window of time after the pop."""

from __future__ import annotations

import itertools

import numpy as np

from punctura import Scene
from punctura.events import Event
from punctura.exercise.limit import Limit, Moment, by, first_of
from punctura.exercise.schema import StopAfterPop
from punctura.exercise.space import place_of
from punctura.exercise.ticks import GONE_S, Flags, JudgedTicks


class StopJudge(Limit):
    """Uses the tip's depth in the membrane, so a wall that springs back along the needle counts too.

    The measurement is open while the membrane holds a tip without a pop since its entry, and then until the window
    after the pop ends. A membrane without a pop was not measured.
    """

    def __init__(self, goal: StopAfterPop, scene: Scene) -> None:
        text = f"Run no more than {goal.within_mm:g} mm past the {goal.membrane} when it gives way"
        super().__init__(goal.text or text)
        self.membrane, self.within, self.seconds = goal.membrane, goal.within_mm * 1e-3, goal.seconds
        self.met: Moment | None = None  # the end of the first window
        self.index = place_of(scene, goal.membrane)
        self._until = -np.inf  # the end of the last window, s
        self._popped = False  # since the tip went in

    @property
    def popped(self) -> bool:
        """Whether the membrane has given way at all."""
        return bool(np.isfinite(self._until))

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        i = self.index
        self._watch(ticks, np.isfinite(ticks.depth[:, i]))
        pops = [event for event in events if event.what == "pop" and event.membrane == i]
        cuts = np.searchsorted(ticks.tick, [event.tick for event in pops]).tolist()
        window = np.zeros(len(ticks), dtype=np.bool_)
        for k, (start, end) in enumerate(itertools.pairwise([0, *cuts, len(ticks)])):
            if k:
                self._until = pops[k - 1].time + self.seconds
            part = ticks.part(slice(start, end))
            self._miss(part, (part.run_on[:, i] > self.within) & (part.time <= self._until))
            # Open until the page is heard again: a hand that it holds does not stop.
            window[start:end] = part.time - part.age <= self._until
            if self.gone is None:
                self.gone = first_of(part, window[start:end] & (part.age > GONE_S))
            if self.met is None and self.popped:
                self.met = first_of(part, ~window[start:end])
        held = ticks.inside[:, i] & ~self._popped_since_entry(ticks, cuts)
        self.busy = window | held
        self.waits_for = "rest" if window[-1] else "pop" if held[-1] else ""

    def _popped_since_entry(self, ticks: JudgedTicks, pops: list[int]) -> Flags:
        rows = np.arange(len(ticks))
        out = ~ticks.inside[:, self.index] & np.isfinite(ticks.depth[:, self.index])
        popped = np.zeros(len(ticks), dtype=np.bool_)
        popped[pops] = True
        last_out = np.maximum.accumulate(np.where(out, rows, -2))
        last_pop = np.maximum.accumulate(np.where(popped, rows, -1 if self._popped else -3))
        flags: Flags = last_pop > last_out
        self._popped = bool(flags[-1])
        return flags

    def measured(self, until: Moment | None) -> bool:
        return by(self.met, until) and super().measured(until)

    def state(self, until: Moment | None, complete: bool) -> str:
        state = super().state(until, complete)
        return "met" if state == "open" and self.measured(until) else state
