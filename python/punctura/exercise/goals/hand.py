"""Goals about how the needle is moved: entry_angle, speed, no_pause, peak_force, time_limit."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np

from punctura.events import Event
from punctura.exercise.fields import Angle, Newtons, Seconds, Speed, Tolerance, asked
from punctura.exercise.goals.goal import BegunJudge, Course, Goal, LimitJudge, SoFar
from punctura.exercise.motion import MeanSpeed
from punctura.exercise.quantities import degrees, speed
from punctura.exercise.result import Remark
from punctura.exercise.seen import STEADILY, Seen, off_angle
from punctura.exercise.ticks import (
    GONE_S,
    LATE_S,
    JudgedTicks,
    Moment,
    Numbers,
    TargetSpace,
    contacts,
    first_of,
    own_time,
)

ROUNDING_RAD = 1e-9
UPRIGHT_RAD = math.radians(3)  # a needle that leans less has no heading
SPEED_MEAN_S = 0.1  # over which a speed is measured: a period of tremor, or nearly


class EntryAngle(Goal):
    """At each entry into the first membrane, the needle has this angle to its surface, and the start's heading."""

    kind: Literal["entry_angle"]
    angle_deg: Angle | None = None  # default: the angle of the start
    within_deg: Annotated[Tolerance, asked("Enter at this angle, within degrees")]
    turned_at_most_deg: Tolerance | None = None  # from the start's heading; default: any heading

    def judge(self, course: Course) -> AngleJudge:
        asked = course.start.angle_deg if self.angle_deg is None else self.angle_deg
        return AngleJudge(self, asked, course)

    @property
    def entry_deg(self) -> float | None:
        return self.angle_deg


class AngleJudge(BegunJudge):
    """Judges each entry into the first membrane."""

    subjects = ("angle",)

    def __init__(self, goal: EntryAngle, asked_deg: float, course: Course) -> None:
        first = course.scene.membranes[0]
        asked = f"Enter the {first.name} at {asked_deg:g} degrees, within {goal.within_deg:g} degrees"
        most = goal.turned_at_most_deg
        super().__init__(goal.text or asked + (f", turned sideways by at most {most:g} degrees" if most else ""))
        self.asked_deg, self.within_deg, self.turned_at_most_deg = asked_deg, goal.within_deg, most
        self.entered: float | None = None  # rad, of the first wrong entry
        self.turned: float | None = None  # rad from the start's heading, of the first entry that is turned too far
        normal = np.asarray(first.inward_normal, np.float64)
        self._normal, self._heading = normal / np.linalg.norm(normal), np.asarray(course.start.heading, np.float64)

    def _turned(self, held: Numbers) -> float:
        """The angle between the needle and the start's heading, seen along the normal, rad; 0 if it is upright."""
        along, asked = (v - (v @ self._normal) * self._normal for v in (held, self._heading))
        if np.linalg.norm(along) <= math.sin(UPRIGHT_RAD):
            return 0.0
        return math.atan2(float(np.linalg.norm(np.cross(asked, along))), float(asked @ along))

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        for when in contacts(events):
            self.began = self.began or when
            row = np.searchsorted(ticks.tick, when.tick)
            angle, turned = float(ticks.angle[row]), self._turned(ticks.held[row])
            if not math.isfinite(angle):
                self.unseen = self.unseen or when
            elif self.missed is not None:
                continue
            elif abs(angle - math.radians(self.asked_deg)) > math.radians(self.within_deg) + ROUNDING_RAD:
                self.entered, self.missed = angle, when
            elif self.turned_at_most_deg and turned > math.radians(self.turned_at_most_deg) + ROUNDING_RAD:
                self.turned, self.missed = turned, when

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        if self.turned is not None:
            turned = f"You entered with the needle turned by {degrees(self.turned)} to the side"
            return f"{turned}; at most {self.turned_at_most_deg:g} are allowed."
        entered = math.degrees(self.entered or 0.0)
        return f"You entered at {entered:.0f} degrees; {self.asked_deg:g} are asked, within {self.within_deg:g}."

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        if self.turned is not None:
            text = f"You entered with the needle turned by {degrees(self.turned)} to the side: turn it back first."
            yield Remark(about="angle", text=text, numbers={"turned_rad": self.turned})
        elif self.entered is not None:
            yield from off_angle(self.entered, seen)


class MostSpeed(Goal):
    """In tissue, the point never moves in faster than this."""

    kind: Literal["speed"]
    at_most_mm_per_s: Annotated[Speed, asked("Push in with at most, mm/s")]

    def judge(self, course: Course) -> SpeedJudge:
        return SpeedJudge(self)


class SpeedJudge(LimitJudge):
    """Judges the mean speed of the last 0.1 s in the tissue, along the needle."""

    def __init__(self, goal: MostSpeed) -> None:
        super().__init__(goal.text or f"Push in with no more than {goal.at_most_mm_per_s:g} mm/s")
        self.at_most = goal.at_most_mm_per_s * 1e-3
        self._speed = MeanSpeed(SPEED_MEAN_S)

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self._watch(ticks, ticks.placed, ticks.in_tissue)
        moved, _ = self._speed.add(ticks)
        self._miss(ticks, np.einsum("ij,ij->i", moved, ticks.held) > self.at_most)

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        return f"You pushed in faster than {self.at_most * 1e3:g} mm/s."

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        fast = seen.trajectory.last.speed
        text = f"You moved in at {speed(fast)}; {speed(self.at_most)} are allowed: push more slowly."
        yield Remark(about="speed", text=text, numbers={"speed_m_per_s": fast, "allowed_m_per_s": self.at_most})


class NoPause(Goal):
    """On the way from the first contact to the space, the needle never stands still for so long."""

    kind: Literal["no_pause"]
    seconds: Annotated[Seconds, asked("Never stand still on the way for, s")] = 1.0

    def judge(self, course: Course) -> PauseJudge:
        return PauseJudge(self, course.target)


class PauseJudge(LimitJudge):
    """Judges the way from first contact to arrival. While the page is late nobody pauses; after more than 1 s of it,
    and if page or computer were late during a pause, nobody knows whether the student stood still."""

    subjects = ("pauses",)

    def __init__(self, goal: NoPause, space: TargetSpace) -> None:
        super().__init__(goal.text or f"Do not stand still for {goal.seconds:g} s on the way to {space.name}")
        self.seconds = goal.seconds
        self._space, self._arrived = space, False

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        arrived = self._arrived | np.logical_or.accumulate(self._space.arrived(ticks))
        self._arrived = bool(arrived[-1])
        on_the_way = ticks.in_tissue & ~arrived
        self._watch(ticks, ticks.placed, on_the_way)
        long = ticks.still >= self.seconds
        if self.gone is None:
            silent = long & ticks.silent & (ticks.age <= LATE_S)
            self.gone = first_of(ticks, on_the_way & (ticks.age > GONE_S) | silent)
        self._lack(ticks, long & ticks.slowed)
        self._miss(ticks, long & ~ticks.silent & ~ticks.slowed)

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        return f"You stood still for {self.seconds:g} s before you reached {space.name}."

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        text = f"You stood still for {self.seconds:g} s on the way to {seen.space.name}: {STEADILY}."
        yield Remark(about="pauses", text=text, numbers={"paused_s": self.seconds})


class PeakForce(Goal):
    """The model's total force stays at or below this."""

    kind: Literal["peak_force"]
    at_most_N: Annotated[Newtons, asked("Force at most, N")]

    def judge(self, course: Course) -> ForceJudge:
        return ForceJudge(self)


class ForceJudge(LimitJudge):
    def __init__(self, goal: PeakForce) -> None:
        super().__init__(goal.text or f"Push with no more than {goal.at_most_N:g} N")
        self.at_most = goal.at_most_N

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self._watch(ticks, np.isfinite(ticks.force), ticks.in_tissue)
        self._miss(ticks, ticks.force > self.at_most)

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        return f"You pushed with more than {self.at_most:g} N."

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        peak = seen.metrics.peak_force
        # The attempt ends with the first tick above the limit, so that the peak is hardly more.
        text = (
            f"You pushed with more than the {seen.newtons(self.at_most)} that are allowed: push more gently, and stop "
            "as soon as a wall gives way."
        )
        yield Remark(about="force", text=text, numbers={"force_N": peak, "allowed_N": self.at_most})

    def praise(self, seen: Seen) -> Iterator[Remark]:
        peak = seen.metrics.peak_force
        text = f"You never pushed with more than {seen.newtons(peak)}; {self.at_most:.2f} N are allowed."
        yield Remark(about="force", text=text, numbers={"force_N": peak, "allowed_N": self.at_most})


class TimeLimit(Goal):
    """Everything is finished within this time after the first contact."""

    kind: Literal["time_limit"]
    seconds: Annotated[Seconds, asked("Time limit, s")]

    def judge(self, course: Course) -> TimeJudge:
        return TimeJudge(self)


class TimeJudge(BegunJudge):
    """Uses the times of the ticks, so lost ticks do not stop the time. The time in which the computer was late is
    nobody's: with it the time may be over, and the goal is not measured."""

    def __init__(self, goal: TimeLimit) -> None:
        super().__init__(goal.text or f"Finish within {goal.seconds:g} s of the first contact")
        self.time_limit: float = goal.seconds
        self._own = 0.0  # s, of the first contact, on the needle's own clock

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        touch = next(iter(contacts(events)), None)
        if self.began is None and touch is not None:
            self.began, self._own = touch, own_time(ticks, touch)
        if self.began is not None:
            self._miss(ticks, ticks.own - self._own > self.time_limit)
            self._lack(ticks, ticks.time - self.began.time > self.time_limit)

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        return f"The time ran out {self.time_limit:g} s after the first contact."
