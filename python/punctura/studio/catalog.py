"""The scenes and exercises that a page can choose."""

import os
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from pydantic import Field

from punctura._core import ForceLimits, tip_length
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.exercise import (
    Attempt,
    Exercise,
    Result,
    cannot_show,
    exercise_names,
    exercises,
    load_exercise,
    thumb_cannot_show,
)
from punctura.exercise.goals import OnLine
from punctura.scene import load_scene, scene_names
from punctura.studio.loaded import problem_parts
from punctura.studio.names import BadName, safe_name
from punctura.studio.own_exercises import OwnExercises
from punctura.studio.view import membrane_views
from punctura.studio.wire.common import MembraneView, Part, ProblemPart, Vector
from punctura.studio.wire.messages import Choice

_USUAL_LIMITS = ForceLimits()  # of a needle's device
Stamp = tuple[int, int] | None  # size and time of a file
Hands = tuple[ForceLimits, ForceLimits | None]  # in effect on the needle's device, and on a second one, if any
DRAFT = "draft"  # the name of an exercise that is tried before it is saved


class SceneOutline(Part):
    """A ready scene for the making of an exercise. SI."""

    name: str
    title: str
    tip_length: float  # m
    syringe: bool
    membranes: list[MembraneView]


@cache
def scene_outlines() -> tuple[SceneOutline, ...]:
    """The ready scenes with their membranes."""
    made = []
    for name in scene_names():
        scene = load_scene(name)
        length, syringe = tip_length(scene.needle), scene.syringe is not None
        views = membrane_views(scene)
        made.append(SceneOutline(name=name, title=scene.name, tip_length=length, syringe=syringe, membranes=views))
    return tuple(made)


@cache
def _ready_scenes() -> tuple[Choice, ...]:
    return tuple(Choice(name=name, title=load_scene(name).name) for name in scene_names())


def ready_scenes() -> list[Choice]:
    """The scenes that come with the package."""
    return list(_ready_scenes())


class GoalLine(Part):
    """The line of an on_line goal."""

    point: Vector  # m
    along: Vector  # of any length
    within: float  # m


class ExerciseOverview(Part):
    """An exercise as the page lists it. SI."""

    name: str
    title: str
    description: str = ""
    instruction: str = ""
    scene: str = ""
    space_name: str = ""
    space: list[int] = Field(default=[])  # the membrane before the space, by index, and the one behind it, if any
    space_from: float = 0.0  # where the space begins behind the far face of the first, m
    space_to: float | None = None  # where it ends, if at a depth, m
    goal_from: float = 0.0  # how deep the needle must come, m
    line: GoalLine | None = None  # that the point must meet
    expert: str = ""  # name of the recording that is the expert's run
    made: bool = False  # in the page; it can be deleted there
    blind: bool = False  # no needle and no depth are shown while it runs
    start_position: Vector = Field(default=[0.0, 0.0, 0.0])  # m
    start_axis: Vector = Field(default=[0.0, -1.0, 0.0])
    goals: list[str] = Field(default=[])
    problems: list[ProblemPart] = Field(default=[])
    warnings: list[ProblemPart] = Field(default=[])
    unfelt: str = ""  # why this device cannot show what the student must feel, and what to do; empty if it can
    note: str = ""  # what is judged in another way here: the plunger, if the thumb is a key


class DraftResults:
    """Keeps the last result only: the next draft has the same name and may ask for something else."""

    last: Result | None = None

    def save(self, result: Result) -> Result:
        self.last = result.model_copy(update={"name": DRAFT})
        return self.last


class Exercises:
    """The exercises of the package, and files from the command line.

    A file is read again when it has changed, so that it may change while the studio runs. A page chooses by name: it
    cannot name a file. Further ones are those that were made in the page (`own`), and the one that is tried
    there (`draft`).
    """

    own: OwnExercises | None = None
    draft: Exercise | None = None

    def __init__(self, files: Sequence[str | os.PathLike[str]] = ()) -> None:
        """Raises ConfigurationError if a file has an error, or the name of another exercise."""
        self._files: dict[str, Path] = {}
        self._kept: dict[Path, tuple[tuple[Stamp, Hands], ExerciseOverview]] = {}
        self._titles: dict[str, str] = {}
        self.drafts = DraftResults()
        self.warnings: list[tuple[Path, Problem]] = []  # of the files when the studio started
        for given in files:
            if given in exercise_names():
                continue  # a ready exercise, listed anyway
            exercise = load_exercise(given)
            reason = self._unfit(exercise.name, exercise.path)
            if reason:
                raise ConfigurationError([Problem("", MISSING, reason)], str(exercise.path))
            self._files[exercise.name] = exercise.path.absolute()
            self._titles[exercise.name] = exercise.title
            self.warnings += [(exercise.path, warning) for warning in exercise.warnings]

    def _unfit(self, name: str, path: Path) -> str:
        """Why the file cannot be listed; empty if it can. The page and the results know it by its name."""
        if not path.is_file():
            return "is not a file that can be read again and again"
        if name in exercise_names():
            return f"has the name of the ready exercise {name}; name the file otherwise"
        if name in self._files:
            return f"has the same name as {self._files[name]}; name one of them otherwise"
        try:
            safe_name(name)
        except BadName as bad:
            return f"cannot be listed by its name: {bad}"
        return ""

    def names(self) -> list[str]:
        """The names of the files first, then those that were made in the page."""
        draft = [DRAFT] if self.draft else []
        return [*draft, *self._files, *self._made(), *exercise_names()]

    def _made(self) -> dict[str, Path]:
        """The files that were made in the page, except those with the name of another exercise."""
        files = self.own.files() if self.own else {}
        return {name: path for name, path in files.items() if not self.taken(name)}

    def taken(self, name: str) -> bool:
        """Whether a file of the command line, a ready exercise or the draft has this name."""
        return name in self._files or name in exercise_names() or name == DRAFT

    def load(self, name: str) -> Exercise:
        """Raises ConfigurationError if the file has an error now; KeyError for a name that is not listed."""
        if name not in self.names():
            raise KeyError(name)
        if name == DRAFT and self.draft:
            return self.draft
        return load_exercise(self._files.get(name) or self._made().get(name) or name)

    def overviews(
        self, limits: ForceLimits = _USUAL_LIMITS, thumb: ForceLimits | None = None
    ) -> list[ExerciseOverview]:
        """All exercises. Of a file with an error: its problems. limits: in effect on the device. thumb: in effect on
        the second device, if there is one."""
        hands = limits, thumb
        draft = [_on(self.draft, hands)] if self.draft else []
        made = [self._own(name, path, hands).model_copy(update={"made": True}) for name, path in self._made().items()]
        own = [self._own(name, path, hands) for name, path in self._files.items()]
        ready = [entry.model_copy(update=_ready_felt(entry.name, hands)) for entry in _ready_exercises()]
        return draft + own + made + ready

    def choices(self) -> list[Choice]:
        """Names, and the titles of the files when the studio started."""
        own = [Choice(name=name, title=title) for name, title in self._titles.items()]
        return own + [Choice(name=entry.name, title=entry.title) for entry in _ready_exercises()]

    def _own(self, name: str, path: Path, hands: Hands) -> ExerciseOverview:
        """The overview. It is kept until the file has another size or time, or a device has other limits."""
        key = (_stamp(path), hands)  # before the file is read
        kept = self._kept.get(path)
        if kept and kept[0] == key:
            return kept[1]
        try:
            exercise = load_exercise(path)
            overview = _on(exercise, hands)
        except ConfigurationError as error:
            return ExerciseOverview(name=name, title=path.name, problems=problem_parts(error.problems))
        if exercise.scene_name in scene_names():  # another scene's file can change by itself
            self._kept[path] = key, overview
        return overview


def _stamp(path: Path) -> Stamp:
    """Size and time of a file; None if there is none."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_size, found.st_mtime_ns


def _overview(exercise: Exercise) -> ExerciseOverview:
    return ExerciseOverview(
        name=exercise.name,
        title=exercise.title,
        description=" ".join(exercise.description.split()),
        instruction=exercise.instruction,
        scene=exercise.scene.name,
        space_name=exercise.file.space.name,
        space=list(exercise.space),
        space_from=exercise.space_depth[0],
        space_to=exercise.space_depth[1],
        goal_from=exercise.goal_depth,
        line=_line(exercise),
        blind=exercise.file.blind,
        start_position=list(exercise.start_position),
        start_axis=list(exercise.start_axis),
        goals=[goal.text for goal in Attempt(exercise, exercise.scene).goals],
        warnings=problem_parts(exercise.warnings),
    )


def _line(exercise: Exercise) -> GoalLine | None:
    goal = next((goal for goal in exercise.goals if isinstance(goal, OnLine)), None)
    if goal is None:
        return None
    return GoalLine(point=[v * 1e-3 for v in goal.point_mm], along=goal.along, within=goal.within_mm * 1e-3)


def _on(exercise: Exercise, hands: Hands) -> ExerciseOverview:
    """The exercise, and what devices with these limits cannot show of it."""
    return _overview(exercise).model_copy(update=_felt(exercise, hands))


def _felt(exercise: Exercise, hands: Hands) -> dict[str, str]:
    """The fields `unfelt` and `note` of the overview."""
    limits, thumb = hands
    needle = cannot_show(exercise, exercise.scene, limits)
    plunger = thumb_cannot_show(exercise, exercise.scene, limits, thumb)
    if thumb is None:
        return {"unfelt": needle, "note": plunger}
    return {"unfelt": " ".join(filter(None, [needle, plunger])), "note": ""}


@cache
def _ready_felt(name: str, hands: Hands) -> dict[str, str]:
    return _felt(load_exercise(name), hands)


@cache
def _ready_exercises() -> tuple[ExerciseOverview, ...]:
    return tuple(_overview(exercise) for exercise in exercises())
