"""Something that follows the ticks of a run, such as an attempt at an exercise."""

import math
import time
from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol

from pydantic import BaseModel

from punctura import Scene
from punctura.errors import sentence_of
from punctura.exercise import Attempt, Exercise
from punctura.exercise.result import Result, Status
from punctura.studio.catalog import DRAFT
from punctura.studio.hand import Heard
from punctura.studio.pump import Publisher
from punctura.studio.wire.messages import ExerciseStatus, Notice
from punctura.ticks import Ticks


class Outcome(NamedTuple):
    """How an activity ended.

    message: for the pages. notice: replaces the message if another activity runs already. remark: said in any case.
    """

    message: BaseModel | None = None
    notice: str = ""
    remark: str = ""


class Activity(Protocol):
    """What a session calls. All calls but `finish` come from the worker's thread."""

    what: str  # a noun for messages, such as "exercise"
    end_at: float | None  # time.monotonic() at which the session ends the run; None: not known yet

    def begin(self, scene: Scene) -> None:
        """The run has started. scene: as the device runs it. Raises ConfigurationError if it does not fit."""

    def ticks(self, ticks: Ticks, now: float) -> Sequence[BaseModel]:
        """Takes the next ticks; now: time.monotonic(). Returns messages for the pages."""

    def scene_change(self) -> None:
        """The user asks for another scene in this run. Raises ValueError to refuse it, with the reason."""

    def stop(self) -> None:
        """The run is over: no tick follows."""

    def finish(self) -> Outcome:
        """Called after `stop`, in another thread, when the recording is finished."""


class Sitting(Protocol):
    """A participant's session: the pages see and do nothing else. docs/perception.md"""

    noise_plays: bool  # at the page that has control, as it says

    def respond(self, question: int, answer: str) -> None:
        """The answer of a page, in the worker's thread."""

    def close(self) -> None:
        """The studio has stopped."""


class Activities:
    """The activity of the present run. Belongs to the worker's thread."""

    def __init__(self, out: Publisher, post: Callable[[Callable[[], None]], None]) -> None:
        """post: runs a job in the worker's thread; from any thread."""
        self._out, self._post = out, post
        self.now: Activity | None = None
        self._outcome_follows = False  # of an activity that has stopped

    def begin(self, activity: Activity, scene: Scene) -> None:
        """Raises ConfigurationError; then there is no activity."""
        activity.begin(scene)
        self.now = activity

    def send_idle(self) -> None:
        """Clears the exercise in the pages, unless the outcome of the last one follows."""
        if not self._outcome_follows:
            self._out.send(ExerciseStatus(exercise="", running=False, instruction="", goals=[], result=""))

    def ticks(self, ticks: Ticks | None) -> None:
        if self.now and ticks:
            for message in self.now.ticks(ticks, time.monotonic()):
                self._out.send(message)

    def due(self, now: float) -> bool:
        """Whether the run must end now, because its activity is over."""
        return self.now is not None and self.now.end_at is not None and now >= self.now.end_at

    def scene_change(self) -> None:
        """Raises ValueError if the activity refuses another scene."""
        if self.now:
            self.now.scene_change()

    def stop(self) -> Callable[[], None]:
        """Stops the activity. The caller calls the returned function in any thread once the recording is finished."""
        activity, self.now = self.now, None
        if activity is None:
            return lambda: None
        activity.stop()
        self._outcome_follows = True

        def finish() -> None:
            outcome = Outcome()
            try:
                outcome = activity.finish()
            finally:
                self._post(lambda: self._send(outcome))

        return finish

    def _send(self, outcome: Outcome) -> None:
        self._outcome_follows = False
        if self.now is None and outcome.message is not None:
            self._out.send(outcome.message)
        elif outcome.notice:
            self._out.send(Notice(text=outcome.notice))
        if outcome.remark:
            self._out.send(Notice(text=outcome.remark))


class Results(Protocol):
    """Where results go."""

    def save(self, result: Result) -> Result:
        """Returns the result with its name. Raises OSError."""


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
        results: Results,
        group: str = "",
        second_device: bool = False,
        heard: Heard | None = None,
        simulated: bool = False,
    ) -> None:
        """recording: the name of the run's recording. results: where the result is saved. group: a class.
        second_device: the thumb is on one. heard: when the page that moves the hand was heard. simulated: the needle's
        device is."""
        self._exercise, self._person, self._recording, self._results = exercise, person, recording, results
        self._group, self._second_device, self._simulated = group, second_device, simulated
        self._heard = heard or Heard()
        self._attempt: Attempt
        self._sent: ExerciseStatus | None = None
        self.end_at: float | None = None

    def begin(self, scene: Scene) -> None:
        self._attempt = Attempt(self._exercise, scene, self._second_device, self._simulated)

    def ticks(self, ticks: Ticks, now: float) -> list[ExerciseStatus]:
        """Returns the status if it has changed."""
        self._attempt.add({**ticks, "page_age": self._heard.age(ticks["time"], now)})
        if self._attempt.settled and self.end_at is None:
            self.end_at = now + LINGER_S
        status = self._status(running=True)
        if status == self._sent:
            return []
        self._sent = status
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
        try:
            name = self._results.save(result).name
        except OSError as error:
            return Outcome(self._status(running=False), remark=f"The result cannot be saved: {sentence_of(error)}")
        verdict = f"{result.title}: {result.verdict}."
        notice = verdict if name == DRAFT else f"The result of the last exercise is saved as {name}."
        return Outcome(self._status(running=False, result=name), notice)

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
