"""The coach: what went well in an attempt, and what to change next time, from measured numbers (docs/exercises.md).

Each function makes the sentences about one thing, whatever the goals are; goals add their own.
"""

import math
from collections.abc import Iterator, Sequence

from punctura import Scene
from punctura.events import Event
from punctura.exercise.course import asked_angle
from punctura.exercise.exercise import ExerciseFile
from punctura.exercise.goals.goal import Achievement, LimitJudge
from punctura.exercise.measures import Measures
from punctura.exercise.quantities import degrees, mm, no_more_than, tenths, times
from punctura.exercise.result import Coaching, Remark
from punctura.exercise.seen import (
    ANGLE_GOOD_DEG,
    ANGLE_OFF_DEG,
    ASIDE_GOOD_M,
    ASIDE_OFF_M,
    CROOKED,
    DRIFT_GOOD_M,
    DRIFT_OFF_M,
    MOST_REMARKS,
    PAUSES_S,
    PRESSED_S,
    STEADILY,
    TREMOR_GOOD_M,
    TREMOR_OFF_M,
    Seen,
    Trajectory,
    off_angle,
)
from punctura.exercise.ticks import JudgedTicks, Moment, TargetSpace


def held_still(seen: Seen) -> Iterator[Remark]:
    hold = seen.hold
    if hold is not None and hold.tremor <= TREMOR_GOOD_M and hold.drift <= DRIFT_GOOD_M:
        text = (
            f"You held still: in {tenths(hold.seconds)} s the tip trembled by {hold.tremor * 1e3:.2f} mm (rms) and "
            f"drifted by {hold.drift * 1e3:.2f} mm."
        )
        numbers = {"tremor_m": hold.tremor, "drift_m": hold.drift, "held_s": hold.seconds}
        yield Remark(about="tremor", text=text, numbers=numbers)


def pushed_steadily(seen: Seen) -> Iterator[Remark]:
    seconds = seen.metrics.time_to_target
    if seconds is not None and seen.steady and seen.metrics.entries == 1:
        text = f"You pushed without a pause from the {seen.first} to {seen.space.name}, at the first entry."
        yield Remark(about="pauses", text=text, numbers={"to_target_s": seconds})


def kept_the_line(seen: Seen) -> Iterator[Remark]:
    m = seen.metrics
    if m.lateral_deviation is None or m.net_distance is None or m.net_distance < 5e-3:
        return
    if seen.trajectory.tissue_read and m.lateral_deviation <= ASIDE_GOOD_M:
        text = f"You kept to the line of entry: the tip went {no_more_than(m.lateral_deviation)} to its side."
        yield Remark(about="aside", text=text, numbers={"aside_m": m.lateral_deviation})


def right_angle(seen: Seen) -> Iterator[Remark]:
    angle = seen.metrics.entry_angle
    if angle is not None and abs(angle - seen.angle) <= math.radians(ANGLE_GOOD_DEG):
        text = f"You entered at {degrees(angle)}; {degrees(seen.angle)} are asked."
        yield Remark(about="angle", text=text, numbers={"angle_rad": angle, "asked_rad": seen.angle})


ORDER = (held_still, pushed_steadily, kept_the_line, right_angle)


def wrong_angle(seen: Seen) -> Iterator[Remark]:
    angle = seen.metrics.entry_angle
    if angle is not None and abs(angle - seen.angle) >= math.radians(ANGLE_OFF_DEG):
        yield from off_angle(angle, seen)


def too_short(seen: Seen) -> Iterator[Remark]:
    """The needle, or its whole tip, never came into the space."""
    space, trajectory = seen.space, seen.trajectory
    ended_early = seen.decision is not None and not seen.timed_out
    if seen.passed or ended_early or not (math.isfinite(trajectory.nearest) and math.isfinite(trajectory.tip_nearest)):
        return
    if not trajectory.tissue_read:
        return  # nobody knows how deep it was
    arrived = seen.arrival is not None
    whole = space.stay_whole if arrived else space.arrive_whole
    if arrived and (not space.stay_whole or seen.metrics.longest_stay > 0):
        return
    depth = space.begins if arrived or space.arrive_depth is None else space.arrive_depth
    point_short = depth - trajectory.nearest
    if point_short > 0.05e-3:
        text = f"The point stayed {mm(point_short)} or more away from {space.name}: push on until {_sign(seen)}."
        yield Remark(about="short", text=text, numbers={"short_m": point_short}, time=trajectory.nearest_at)
        return
    tip_short = depth - trajectory.tip_nearest
    if whole and tip_short > 0.05e-3:
        text = (
            f"The point was in {space.name}, but the end of the tip was still {mm(tip_short)} outside: go on until "
            f"the {seen.before} gives way."
        )
        yield Remark(about="short", text=text, numbers={"short_m": tip_short})


def _sign(seen: Seen) -> str:
    return f"you notice {seen.space.sign}" if seen.space.sign else f"the {seen.before} gives way"


def pressed(seen: Seen) -> Iterator[Remark]:
    trajectory = seen.trajectory
    if trajectory.pressed_s < PRESSED_S or trajectory.pressed_m < 0.05e-3:
        return
    what = f"against the {seen.after}" if seen.after else "too deep"
    text = (
        f"You were {what} for {tenths(trajectory.pressed_s)} s, up to {mm(trajectory.pressed_m)} behind the end of "
        f"{seen.space.name}: draw back as soon as "
        + ("the force grows again." if seen.after else f"you are {mm(seen.space.ends)} past the {seen.before}.")
    )
    numbers = {"pressed_s": trajectory.pressed_s, "pressed_m": trajectory.pressed_m}
    yield Remark(about="pressed", text=text, numbers=numbers, time=trajectory.pressed_at)


def left_the_space(seen: Seen) -> Iterator[Remark]:
    left, longest = seen.trajectory.left, seen.metrics.longest_stay
    if seen.hold_s is None or left == 0:
        return
    text = (
        f"You left {seen.space.name} {times(left)} before you had held for {seen.hold_s:g} s; your "
        f"longest stay was {tenths(longest)} s: stop, keep the needle still, and only then count."
    )
    yield Remark(about="left", text=text, numbers={"stays": left + 1, "longest_s": longest})


def trembled(seen: Seen) -> Iterator[Remark]:
    hold = seen.hold
    if hold is None:
        return
    if hold.tremor >= TREMOR_OFF_M:
        text = f"The tip trembled by {hold.tremor * 1e3:.2f} mm (rms) while you held: keep the needle still."
        yield Remark(about="tremor", text=text, numbers={"tremor_m": hold.tremor, "held_s": hold.seconds})
    if hold.drift >= DRIFT_OFF_M:
        text = f"The tip drifted by {mm(hold.drift)} while you held for {tenths(hold.seconds)} s: hold the depth."
        yield Remark(about="drift", text=text, numbers={"drift_m": hold.drift, "held_s": hold.seconds})


def paused(seen: Seen) -> Iterator[Remark]:
    count, seconds = seen.pauses
    if seconds >= PAUSES_S:
        text = f"You stood still {times(count)} in the tissue on the way, for {tenths(seconds)} s together: {STEADILY}."
        yield Remark(about="pauses", text=text, numbers={"pauses": count, "paused_s": seconds})


def went_aside(seen: Seen) -> Iterator[Remark]:
    aside, straightness = seen.metrics.lateral_deviation, seen.metrics.straightness
    if aside is None or straightness is None or (aside < ASIDE_OFF_M and straightness < CROOKED):
        return
    text = f"The tip went up to {mm(aside)} to the side of its line of entry: push along the needle."
    yield Remark(about="aside", text=text, numbers={"aside_m": aside, "straightness": straightness})


FIRST = (wrong_angle, too_short, pressed, left_the_space)  # before what the goals advise
LAST = (trembled, paused, went_aside)

# Praise that a reader would take for the opposite of what is to change: subjects of both.
CONTRADICTS = {"line": ("aside", "pauses"), "left": ("tremor",), "speed": ("pauses",)}


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
        self._trajectory = Trajectory(space, scene.servo.rate)

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        """Takes ticks with their stays marked, and their events."""
        self._trajectory.add(ticks, events)

    def words(self, passed: bool, decision: Moment | None, measures: Measures) -> Coaching:
        """At most MOST_REMARKS sentences of each sort, the most important first."""
        decided = decision is not None and not passed
        missed = [one for one in self._limits if decided and one.state(decision, False) == "missed"]
        holds = [one.seconds for one in self._judges if isinstance(one, Achievement) and one.seconds > 0]
        space = self._file.space
        seen = Seen(
            passed, decision, max(holds, default=None), any(one.time_limit is not None for one in missed),
            self._space, space.behind, space.in_front_of or "", self._first, asked_angle(self._file),
            measures.metrics(), measures.first_touch, self._trajectory,
        )  # fmt: skip
        change = list({one.about: one for one in reversed(list(self._change(seen, missed)))}.values())[::-1]
        wrong = {about for one in change for about in (one.about, *CONTRADICTS.get(one.about, ()))}
        wrong |= {about for one in self._limits if one.state(decision, True) != "met" for about in one.subjects}
        good = [one for one in self._good(seen) if one.about not in wrong]
        return Coaching(good=good[:MOST_REMARKS], change=change[:MOST_REMARKS])

    def _good(self, seen: Seen) -> Iterator[Remark]:
        for limit in self._limits:
            if limit.state(seen.decision, True) == "met":
                yield from limit.praise(seen)
        for speak in ORDER:
            yield from speak(seen)

    def _change(self, seen: Seen, missed: list[LimitJudge]) -> Iterator[Remark]:
        for judge in self._judges:
            if isinstance(judge, Achievement):
                yield from judge.corrections(seen)
            elif judge in missed and judge.missed is not None:
                for remark in judge.corrections(seen):
                    yield remark.model_copy(update={"time": judge.missed.time})
        for speak in FIRST:
            yield from speak(seen)
        for limit in self._limits:
            yield from limit.advice(seen)
        for speak in LAST:
            yield from speak(seen)
