"""Follows an attempt, and says at its end what went well and what to change next time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice

from punctura import Scene
from punctura.events import Event
from punctura.exercise.coach import change, good
from punctura.exercise.coach.seen import Seen
from punctura.exercise.coach.thresholds import MOST_REMARKS
from punctura.exercise.coach.trace import Trace
from punctura.exercise.course import asked_angle
from punctura.exercise.judge import Achievement, LimitJudge
from punctura.exercise.measures import Measures
from punctura.exercise.moment import Moment
from punctura.exercise.result import Coaching, Remark
from punctura.exercise.schema import ExerciseFile
from punctura.exercise.space import TargetSpace
from punctura.exercise.ticks import JudgedTicks


class Coach:
    """`add` takes the ticks up to the decision; `words` may be called at any time."""

    def __init__(
        self, file: ExerciseFile, scene: Scene, space: TargetSpace, judges: Sequence[LimitJudge | Achievement]
    ) -> None:
        """judges: those of the goals, in the order in which the coach speaks of them."""
        self._file, self._space = file, space
        self._limits = [judge for judge in judges if isinstance(judge, LimitJudge)]
        self._judges = judges
        self._first = scene.membranes[0].name
        self._trace = Trace(space, scene.servo.rate)

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        """Takes ticks with their stays marked, and their events."""
        self._trace.add(ticks, events)

    def words(self, passed: bool, decision: Moment | None, measures: Measures) -> Coaching:
        """At most MOST_REMARKS sentences of each sort, the most important first."""
        decided = decision is not None and not passed
        missed = [one for one in self._limits if decided and one.state(decision, False) == "missed"]
        holds = [one.seconds for one in self._judges if isinstance(one, Achievement) and one.seconds > 0]
        space = self._file.space
        seen = Seen(
            passed, decision, max(holds, default=None), any(one.time_limit is not None for one in missed),
            self._space, space.behind, space.in_front_of or "", self._first, asked_angle(self._file),
            measures.metrics(), measures.first_touch, self._trace,
        )  # fmt: skip
        return Coaching(
            good=list(islice(self._good(seen), MOST_REMARKS)),
            change=list(islice(self._change(seen, missed), MOST_REMARKS)),
        )

    def _good(self, seen: Seen) -> Iterator[Remark]:
        for limit in self._limits:
            if limit.state(seen.decision, True) == "met":
                yield from limit.praise(seen)
        for speak in good.ORDER:
            yield from speak(seen)

    def _change(self, seen: Seen, missed: list[LimitJudge]) -> Iterator[Remark]:
        for judge in self._judges:
            if judge in missed or isinstance(judge, Achievement):
                yield from judge.corrections(seen)
        for speak in change.FIRST:
            yield from speak(seen)
        for limit in self._limits:
            yield from limit.advice(seen)
        for speak in change.LAST:
            yield from speak(seen)
