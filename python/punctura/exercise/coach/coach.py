"""Follows an attempt, and says at its end what went well and what to change next time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from punctura import Scene
from punctura.events import Event
from punctura.exercise.achievements import Achievement
from punctura.exercise.coach import change, good
from punctura.exercise.coach.seen import Seen
from punctura.exercise.coach.thresholds import MOST_REMARKS
from punctura.exercise.coach.trace import Trace
from punctura.exercise.limit import Limit, Moment
from punctura.exercise.measures import Measures
from punctura.exercise.motion_limits import asked_angle
from punctura.exercise.remark import Coaching, Remark
from punctura.exercise.schema import ExerciseFile
from punctura.exercise.space import TargetSpace
from punctura.exercise.ticks import JudgedTicks

Speaker = Callable[[Seen], Iterator[Remark]]


class Coach:
    """`add` takes the ticks up to the decision; `words` may be called at any time."""

    def __init__(self, file: ExerciseFile, scene: Scene, space: TargetSpace) -> None:
        self._file, self._space = file, space
        self._first = scene.membranes[0].name
        self._trace = Trace(space, scene.servo.rate)

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        """Takes ticks with their stays marked, and their events."""
        self._trace.add(ticks, events)

    def words(
        self,
        passed: bool,
        decision: Moment | None,
        limits: Sequence[Limit],
        achievements: Sequence[Achievement],
        measures: Measures,
    ) -> Coaching:
        """At most MOST_REMARKS sentences of each sort."""
        space = self._file.space
        seen = Seen(
            passed, decision, limits, achievements, self._space, space.behind, space.in_front_of or "", self._first,
            asked_angle(self._file), measures.metrics(), measures.first_touch, self._trace,
        )  # fmt: skip
        return Coaching(good=_first(good.ORDER, seen), change=_first(change.ORDER, seen))


def _first(speakers: Sequence[Speaker], seen: Seen) -> list[Remark]:
    return [remark for speaker in speakers for remark in speaker(seen)][:MOST_REMARKS]
