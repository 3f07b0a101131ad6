"""Something that follows the ticks of a run: an attempt at an exercise is one."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol

from pydantic import BaseModel

from punctura import Scene
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

    def tell_idle(self) -> None:
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
                self._post(lambda: self._tell(outcome))

        return finish

    def _tell(self, outcome: Outcome) -> None:
        self._outcome_follows = False
        if self.now is None and outcome.message is not None:
            self._out.send(outcome.message)
        elif outcome.notice:
            self._out.send(Notice(text=outcome.notice))
        if outcome.remark:
            self._out.send(Notice(text=outcome.remark))
