"""An attempt at an exercise as an activity: its messages for the pages, and its result."""

from __future__ import annotations

import math

from punctura import Scene
from punctura.errors import sentence_of
from punctura.exercise import Attempt, Exercise, ResultStore
from punctura.exercise.result import Status
from punctura.studio.activity import Outcome
from punctura.studio.hand import Heard
from punctura.studio.wire.messages import ExerciseStatus
from punctura.ticks import Ticks

LINGER_S = 1.0  # the recording goes on for this long after the decision and the last overshoot


def _tenths(seconds: float) -> float:
    """Rounded down, so that a page gets at most ten messages a second."""
    return math.floor(seconds * 10 + 1e-9) / 10


class ExerciseActivity:
    """One attempt."""

    what = "exercise"

    def __init__(
        self,
        exercise: Exercise,
        person: str,
        recording: str,
        results: ResultStore | None,
        group: str = "",
        second_device: bool = False,
        heard: Heard | None = None,
    ) -> None:
        """recording: the name of the run's recording. results: where the result is saved, if at all. group: a class.
        second_device: the thumb is on one. heard: when the page that moves the hand was heard."""
        self._exercise, self._person, self._recording, self._results = exercise, person, recording, results
        self._group, self._second_device = group, second_device
        self._heard = heard or Heard()
        self._attempt: Attempt
        self._told: ExerciseStatus | None = None
        self.end_at: float | None = None

    def begin(self, scene: Scene) -> None:
        self._attempt = Attempt(self._exercise, scene, self._second_device)

    def ticks(self, ticks: Ticks, now: float) -> list[ExerciseStatus]:
        """Returns the status if it has changed."""
        self._attempt.add({**ticks, "page_age": self._heard.age(ticks["time"], now)})
        if self._attempt.settled and self.end_at is None:
            self.end_at = now + LINGER_S
        status = self._status(running=True)
        if status == self._told:
            return []
        self._told = status
        return [status]

    def scene_change(self) -> None:
        raise ValueError("end the exercise before you change its scene")

    def stop(self) -> None:
        """The result waits for the recording: `finish`."""

    def finish(self) -> Outcome:
        """Saves the result, unless the needle has never entered and nothing was decided."""
        result = self._attempt.finish(self._person, self._recording, group=self._group)
        if not self._attempt.over and result.metrics.entries == 0:
            return Outcome(self._status(running=False))
        if self._results is None:
            said = " ".join(
                [f"{result.title}: {result.verdict}.", *result.reasons, "The result of a draft is not kept."]
            )
            return Outcome(self._status(running=False), remark=said)
        try:
            name = self._results.save(result).name
        except OSError as error:
            return Outcome(self._status(running=False), remark=f"The result cannot be saved: {sentence_of(error)}")
        return Outcome(self._status(running=False, result=name), f"The result of the last exercise is saved as {name}.")

    def _status(self, running: bool, result: str = "") -> ExerciseStatus:
        status = self._attempt.status
        if running and self._exercise.file.blind and not self._attempt.over:
            status = self._blindfold(status)
        tenths = {"held": _tenths(status.held), "time": _tenths(status.time)}
        return ExerciseStatus(
            **dict(status) | tenths,
            exercise=self._exercise.name,
            running=running,
            result=result,
            blind=self._exercise.file.blind,
        )

    def _blindfold(self, status: Status) -> Status:
        """Without what tells where the needle is: the goals' states, the stay, the instruction of the moment."""
        goals = [goal.model_copy(update={"state": "open"}) for goal in status.goals]
        instruction = self._exercise.instruction
        return status.model_copy(update={"instruction": instruction, "goals": goals, "held": 0.0, "hold": 0.0})
