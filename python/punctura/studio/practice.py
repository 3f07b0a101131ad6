"""An exercise in progress: what the page is told of it, and its result."""

from __future__ import annotations

from punctura import Scene
from punctura.exercise import Attempt, Exercise, ResultStore
from punctura.studio.wire.messages import ExerciseGoal, ExerciseStatus
from punctura.ticks import Ticks

LINGER_S = 1.0  # that is still recorded after the decision, once all overshoots are measured


def no_exercise() -> ExerciseStatus:
    return ExerciseStatus(exercise="", running=False, instruction="", goals=[], result="")


class Practice:
    """One attempt. Of the worker's thread, but for `keep`."""

    def __init__(self, exercise: Exercise, scene: Scene, person: str, recording: str) -> None:
        """scene: as it runs. recording: the name of the run's. Raises ConfigurationError."""
        self.exercise, self.person, self.recording = exercise, person, recording
        self._attempt = Attempt(exercise, scene)
        self._told: ExerciseStatus | None = None
        self.end_at: float | None = None  # s, on the clock of `add`: when the run may end

    def add(self, ticks: Ticks, now: float) -> ExerciseStatus | None:
        """The next ticks. What to tell the pages, if anything is new."""
        self._attempt.add(ticks)
        if self._attempt.settled and self.end_at is None:
            self.end_at = now + LINGER_S
        status = self._status(running=True)
        if status == self._told:
            return None
        self._told = status
        return status

    def keep(self, store: ResultStore, worthless: bool = False) -> ExerciseStatus:
        """Saves the result. worthless: an attempt without an entry is not kept. The last thing the pages are told."""
        result = self._attempt.finish(self.person, self.recording)
        if worthless and not self._attempt.over and result.metrics.attempts == 0:
            return self._status(running=False)
        return self._status(running=False, result=store.save(result).name)

    def _status(self, running: bool, result: str = "") -> ExerciseStatus:
        status = self._attempt.status
        return ExerciseStatus(
            exercise=self.exercise.name,
            running=running,
            instruction=status.instruction,
            goals=[ExerciseGoal(text=goal.text, state=goal.state) for goal in status.goals],
            result=result,
        )
