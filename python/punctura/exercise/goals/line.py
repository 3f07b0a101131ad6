"""Goals about a line: on_line (a line of the scene), straight (the line of entry)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray

from punctura import Scene
from punctura._core import grazing_cosine
from punctura.errors import Problem
from punctura.events import Event
from punctura.exercise.fields import Distance, Vector, asked, no_direction
from punctura.exercise.goals.goal import BegunJudge, Course, Given, Goal, SoFar
from punctura.exercise.quantities import mm, no_more_than, tenths
from punctura.exercise.result import Remark
from punctura.exercise.seen import Seen
from punctura.exercise.ticks import JudgedTicks, Moment, TargetSpace, contacts, first_of


def across(scene: Scene, along: list[float]) -> NDArray[np.float64]:
    """The direction across a line on the first membrane's surface, of length 1; NaN if the line is upright."""
    side: NDArray[np.float64] = np.cross(np.asarray(scene.membranes[0].inward_normal, np.float64), along)
    length = float(np.linalg.norm(side))
    return side / length if length > 1e-9 else np.full(3, np.nan)


_WAYS = (("to the left", "to the right"), ("down", "up"), ("away from you", "towards you"))  # of x, y and z


class OnLine(Goal):
    """While the point is in the space, it is not farther to the side of a line than this.

    The distance is measured along the first membrane's surface, at a right angle to the line.
    """

    kind: Literal["on_line"]
    point_mm: Vector  # any point of the line
    along: Vector  # its direction
    within_mm: Distance

    def judge(self, course: Course) -> LineJudge:
        return LineJudge(self, course.scene)

    @classmethod
    def problems(cls, given: Given, space: Given, scene: Scene | None) -> Iterator[Problem]:
        """The direction must have a length, and must not be upright."""
        along = given.get("along")
        if along is None:
            return
        if reason := no_direction(along):
            yield Problem("along", along, reason)
        elif scene is not None and np.isnan(across(scene, along)).any():
            yield Problem("along", along, "must not be parallel to the first membrane's normal")


class LineJudge(BegunJudge):
    """Uses the position of the tip in the ticks in which the point is in the space."""

    def __init__(self, goal: OnLine, scene: Scene) -> None:
        super().__init__(goal.text or f"Keep the point within {goal.within_mm:g} mm of the middle line")
        self.within = goal.within_mm * 1e-3
        self.farthest: float | None = None  # m, to the side; up to the first miss
        self._entered = 0.0  # m, to the side, as the point came into the space
        self._point, self._across = np.asarray(goal.point_mm) * 1e-3, across(scene, goal.along)
        self.aim: float | None = None  # m to the side, where the needle points at the line's depth in the last tick
        self._normal = np.asarray(scene.membranes[0].inward_normal) / np.linalg.norm(scene.membranes[0].inward_normal)

    @property
    def way(self) -> str:
        """Where to move a needle that points beside the line, seen by the user."""
        way = -np.sign(self.aim or 0.0) * self._across
        axis = int(np.abs(way).argmax())
        return _WAYS[axis][int(way[axis] > 0)]

    def _points(self, ticks: JudgedTicks) -> None:
        offset, held = ticks.tip[-1] - self._point, ticks.held[-1]
        left = max(0.0, -float(offset @ self._normal) / max(grazing_cosine, float(held @ self._normal)))
        aim = float((offset + left * held) @ self._across)
        self.aim = aim if np.isfinite(aim) else None

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self._points(ticks)
        aside = np.abs((ticks.tip - self._point) @ self._across)
        self._watch(ticks, np.isfinite(aside), ticks.in_space[:, 0])
        here = ticks.in_space[:, 0] & np.isfinite(aside)
        if self.missed is not None or not here.any():
            return
        if self.began is None:
            self.began, self._entered = first_of(ticks, here), float(aside[here.argmax()])
        off = here & (aside > self.within)
        self._miss(ticks, off)
        until = here & (np.arange(len(ticks)) <= (int(off.argmax()) if off.any() else len(ticks)))
        self.farthest = max(self.farthest or 0.0, float(aside[until].max()))

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        if self._entered > self.within:
            return f"The point came into {space.name} {tenths(self._entered * 1e3)} mm beside the middle line."
        return f"In {space.name}, the point went more than {mm(self.within)} beside the middle line."

    def never_measured(self, first: str) -> str:
        return f"Not measured: “{self.text}”, because the point was never in the space."

    def aiming(self, inside: bool) -> str:
        if abs(self.aim or 0.0) <= self.within:
            return ""
        half_mm = round(abs(self.aim or 0.0) * 2e3) / 2
        if inside:
            return f"The needle points {half_mm:g} mm beside the line: draw it out, and move it {self.way}."
        return f"Move the needle {half_mm:g} mm {self.way}, until it points at the line. Then push in."

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        beside, allowed, space = self.farthest or 0.0, mm(self.within), seen.space.name
        if self._entered > self.within:
            text = (
                f"The point was {mm(beside)} beside the middle line when it came into {space}; {allowed} are allowed: "
                "move the needle sideways before you enter, until it points at the line."
            )
        else:
            text = (
                f"You came into {space} on its middle line, then moved more than {allowed} to the side: "
                "hold the needle still until the end."
            )
        yield Remark(about="line", text=text, numbers={"beside_m": beside, "allowed_m": self.within})

    def praise(self, seen: Seen) -> Iterator[Remark]:
        if self.farthest is not None:
            beside = no_more_than(self.farthest)
            text = f"You hit the middle of {seen.space.name}: {beside} to the side of its middle line."
            yield Remark(about="line", text=text, numbers={"beside_m": self.farthest, "allowed_m": self.within})


class Straight(Goal):
    """In the tissue, the point is never farther than this to the side of the line of its entry."""

    kind: Literal["straight"]
    within_mm: Annotated[Distance, asked("Stay on the line of entry, within mm")]

    def judge(self, course: Course) -> StraightJudge:
        return StraightJudge(self)


class StraightJudge(BegunJudge):
    """Judges each way in the tissue: its line is the needle's as it touches the first membrane."""

    subjects = ("aside",)

    def __init__(self, goal: Straight) -> None:
        super().__init__(goal.text or f"Stay within {goal.within_mm:g} mm of the line of entry")
        self.within = goal.within_mm * 1e-3

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        self.began = self.began or next(iter(contacts(events)), None)
        inside = ticks.in_tissue
        self._watch(ticks, np.isfinite(ticks.aside), inside)
        self._miss(ticks, inside & (ticks.aside > self.within))

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        return f"The tip went more than {mm(self.within)} to the side of its line of entry."

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        text = (
            f"The tip went more than {mm(self.within)} to the side of its line of entry: push along the needle, and "
            "hold it there."
        )
        yield Remark(about="aside", text=text, numbers={"allowed_m": self.within})
