"""Judges how much is injected after the plunger of a syringe gives way."""

from __future__ import annotations

import itertools

import numpy as np

from punctura import Scene
from punctura.errors import ConfigurationError, Problem
from punctura.events import Event
from punctura.exercise.limit import Limit, Moment, by, first_of
from punctura.exercise.schema import ExerciseFile, FeelPlunger, StopPlunger
from punctura.exercise.ticks import JudgedTicks


def judges_plunger(file: ExerciseFile) -> bool:
    """Whether a goal judges the plunger."""
    return any(isinstance(goal, FeelPlunger | StopPlunger) for goal in file.goal)


def need_syringe(file: ExerciseFile, scene: Scene) -> None:
    """Raises ConfigurationError if a goal judges the plunger and the running scene has none."""
    if scene.syringe is None and judges_plunger(file):
        raise ConfigurationError(
            [Problem("scene", scene.name, "has no syringe, [syringe], whose plunger the exercise judges")]
        )


class PlungerJudge(Limit):
    """Uses the volume that has left the syringe. It is open from the tick at which the plunger gives way until the
    window ends. A plunger that never gave way was not measured."""

    def __init__(self, goal: StopPlunger) -> None:
        text = f"Inject no more than {goal.within_mL:g} mL in the {goal.seconds:g} s after the plunger gives way"
        super().__init__(goal.text or text)
        self.within, self.seconds = goal.within_mL * 1e-6, goal.seconds
        self.met: Moment | None = None  # the end of the first window
        self.gave_way = False
        self._until, self._from = -np.inf, np.nan  # end of the last window, s; volume at its start, m^3

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self._watch(ticks, np.isfinite(ticks.injected))
        cuts = np.flatnonzero(ticks.gave_way).tolist()
        window = np.zeros(len(ticks), dtype=np.bool_)
        for k, (start, end) in enumerate(itertools.pairwise([0, *cuts, len(ticks)])):
            if k:
                self.gave_way = True
                self._until, self._from = float(ticks.time[start]) + self.seconds, float(ticks.injected[start])
            part = ticks.part(slice(start, end))
            window[start:end] = part.time <= self._until
            self._miss(part, (part.injected - self._from > self.within) & window[start:end])
            if self.met is None and self.gave_way:
                self.met = first_of(part, ~window[start:end])
        self.busy = window
        self.waits_for = "thumb" if window[-1] else ""

    def measured(self, until: Moment | None) -> bool:
        return by(self.met, until) and super().measured(until)

    def state(self, until: Moment | None, complete: bool) -> str:
        state = super().state(until, complete)
        return "met" if state == "open" and self.measured(until) else state
