"""What every kind of goal has: keys of the file, a judge, and what the rest of an exercise asks of it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, ClassVar, NamedTuple, TypeAlias

from punctura import Scene
from punctura.errors import Problem
from punctura.exercise.fields import Space, Start, Word
from punctura.exercise.judge import Achievement, LimitJudge
from punctura.exercise.space import TargetSpace
from punctura.files.tables import Table

Given: TypeAlias = dict[str, Any]  # a table of the file with only the values that are valid by themselves


class Course(NamedTuple):
    """Where an attempt takes place."""

    scene: Scene  # the running one
    start: Start
    space: Space  # as in the file
    target: TargetSpace  # the same in the scene


class Goal(Table):
    """A goal of an exercise. A kind of goal is a subclass with its own `kind`, in one file of this folder."""

    text: Word | None = None  # replaces the generated sentence

    needs_syringe: ClassVar[bool] = False

    def judge(self, course: Course) -> LimitJudge | Achievement:
        """The judge of an attempt. The scene must have the goal's membrane."""
        raise NotImplementedError

    @classmethod
    def problems(cls, given: Given, space: Given, scene: Scene | None) -> Iterator[Problem]:
        """The problems of keys that do not fit together. The paths are keys of this goal."""
        yield from ()

    @property
    def felt_membrane(self) -> str | None:
        """The membrane whose loss of resistance the student must feel."""
        return None

    @property
    def entry_deg(self) -> float | None:
        """The angle of entry that it asks for, if it names one."""
        return None

    @property
    def push_N(self) -> float | None:
        """The force with which the thumb must push."""
        return None
