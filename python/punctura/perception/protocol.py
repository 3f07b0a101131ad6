"""A protocol: the schema of its file, and the protocol after checking (docs/perception.md)."""

import hashlib
import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field
from pydantic_core import PydanticCustomError

from punctura import Scene
from punctura.files.fields import Number, Numbers, Text, WholeNumber
from punctura.files.tables import Schema, Table
from punctura.perception.psychometric import Shape
from punctura.perception.stimulus import QUANTITIES, Felt
from punctura.perception.words import WordsTable
from punctura.scene import scene_names

Method = Literal["constant", "staircase", "quest", "adjustment"]
Task = Literal["two_intervals", "three_intervals", "yes_no", "rating", "magnitude", "adjustment"]
ANSWERS: dict[str, tuple[str, ...]] = {
    "two_intervals": ("first", "second"),
    "three_intervals": ("first", "second", "third"),
    "yes_no": ("yes", "no"),
    "rating": tuple("123456789"),
    "magnitude": (),  # any number above 0
    "adjustment": ("less", "more", "equal"),
}
ONE_INTERVAL = ("yes_no", "rating", "magnitude")
_NUMBER = re.compile(r"\d{1,9}(\.\d{1,9})?|\.\d{1,9}")
KEYS = {"first": "1", "second": "2", "third": "3", "yes": "y", "no": "n", "less": "-", "more": "+", "equal": "="}


def _valid(holds: Callable[[Any], bool], reason: str) -> AfterValidator:
    def checked(value: object) -> object:
        if not holds(value):
            raise PydanticCustomError("bounds", "{reason}", {"reason": reason})
        return value

    return AfterValidator(checked)


def _within(least: int, most: int) -> AfterValidator:
    return _valid(lambda value: least <= value <= most, f"must be from {least} to {most}")


Several = Annotated[WholeNumber, _within(0, 1000)]  # trials
Steps = Annotated[WholeNumber, _within(1, 100)]
Levels = Annotated[
    Numbers,
    _valid(
        lambda given: 3 <= len(given) <= 100 and all(map(math.isfinite, given)) and sorted({*given}) == [*given],
        "must be 3 to 100 finite numbers, each larger than the one before",
    ),
]
Ends = Annotated[
    Numbers,
    _valid(
        lambda given: len(given) == 2 and all(map(math.isfinite, given)) and given[0] < given[1],
        "must be two finite numbers, the smaller one first",
    ),
]
Break = Annotated[Number, _valid(lambda value: 0 < float(value) <= 3600, "must be more than 0 and at most 3600")]


class StimulusTable(Table):
    """What differs between the trials. SI."""

    variable: Text  # a path of the scene, or one of QUANTITIES
    levels: Levels
    reference: Number | None = None  # level of the other intervals; not for ONE_INTERVAL
    solve: Text | None = None  # for a quantity: the path whose number is solved ...
    between: Ends | None = None  # ... between these two
    membrane: Text | None = None  # whose pop is judged; default: the first
    judged: Literal["drop", "contrast", "peak", "roughness"] = "drop"  # what a simulated observer judges
    solver: Literal["paper", "exact"] | None = None  # of the scene's [servo], in the intervals with the level ...
    reference_solver: Literal["paper", "exact"] | None = None  # ... and in the others


class TrialsTable(Table):
    """How many trials, and in which order."""

    per_level: WholeNumber | None = None  # of constant stimuli
    total: WholeNumber | None = None  # of a staircase and QUEST+; settings of an adjustment
    blocks: Annotated[WholeNumber, _within(1, 1000)] = 1
    practice: Several = 0  # before the first block, at the easiest level; not analysed
    catch: Several = 0  # in each block, at catch_level
    catch_level: Number | None = None  # yes_no: without what is asked for; otherwise clearer than the levels
    up: Steps = 3  # steps of a staircase after a wrong answer
    down: Steps = 1  # and after a right one: it stays where up/(up + down) of the answers are right
    break_s: Break | None = None  # after each block


class ProtocolFile(Table):
    """A protocol: what is shown, what is asked, and in which order."""

    title: Text
    question: Text  # asked after each trial
    instruction: Text = ""  # shown at the start
    consent: Text = ""  # the participant agrees to it before the first trial
    source: Text = ""  # of the numbers
    picture: bool = False  # whether the needle and the membranes are shown
    noise: bool = False  # whether the page plays masking noise
    scene: Text  # a ready scene, or the path of a scene file relative to this file
    method: Method
    task: Task
    seed: Annotated[WholeNumber, _valid(lambda value: value >= 0, "must be 0 or more")] = 0
    stimulus: StimulusTable
    trials: TrialsTable = TrialsTable()
    answers: dict[str, Text] = Field(default_factory=dict)  # the key of each answer
    values: dict[str, Number] = Field(default_factory=dict)  # numbers of the scene in all intervals
    words: WordsTable = WordsTable()  # the session's sentences and answers in the participant's language

    @property
    def levels(self) -> list[float]:
        """As the file has them."""
        return [float(level) for level in self.stimulus.levels]

    @property
    def scored(self) -> int:
        """The number of trials without practice and catch; settings of an adjustment."""
        each = (self.trials.per_level or 0) * len(self.stimulus.levels)
        return each if self.method == "constant" else self.trials.total or 0


SCHEMA = Schema(
    ProtocolFile,
    {
        "stimulus": StimulusTable,
        "trials": TrialsTable,
        "words": WordsTable,
        "answers": ProtocolFile,
        "values": ProtocolFile,
    },
)


@dataclass(frozen=True)
class Stimulus:
    """One interval: a level, its scene, and what a hand without tremor feels of it."""

    level: float
    scene: Scene
    felt: Felt


@dataclass(frozen=True)
class Protocol:
    """A checked protocol, as `load_protocol` returns it. SI."""

    path: Path  # of its file
    file: ProtocolFile  # what the file says
    stimuli: tuple[Stimulus, ...]  # one a level, from the lowest to the highest
    references: tuple[Stimulus, ...]  # for each level the other intervals; empty without other intervals
    catch: Stimulus | None  # of trials without the stimulus
    membrane: int  # the judged one
    unit: str  # of the levels; empty without one

    @property
    def name(self) -> str:
        """Name of the file without its suffix."""
        return self.path.stem

    @cached_property
    def levels(self) -> tuple[float, ...]:
        """From the lowest to the highest."""
        return tuple(one.level for one in self.stimuli)

    @property
    def scene_name(self) -> str:
        """The name of the ready scene, or the path of the scene file."""
        given = self.file.scene
        return given if given in scene_names() else str(self.path.parent / given)

    @cached_property
    def intervals(self) -> int:
        """The number of intervals of a trial."""
        return {"three_intervals": 3}.get(self.file.task, 1 if self.file.task in ONE_INTERVAL else 2)

    @property
    def rates(self) -> bool:
        """Whether the answers are numbers, which have a slope and no threshold."""
        return self.file.task in ("rating", "magnitude")

    @property
    def adjusts(self) -> bool:
        """Whether the second interval is set until it equals the first: a trial is one look, and "equal" a setting."""
        return self.file.task == "adjustment"

    @property
    def reference(self) -> float | None:
        """The level of the other intervals; None if they have the level of the trial, or there are none."""
        return None if self.file.stimulus.reference is None else float(self.file.stimulus.reference)

    @cached_property
    def answers(self) -> dict[str, str]:
        """The key of each answer, in the order of the task."""
        return {name: self.file.answers.get(name, KEYS.get(name, name)) for name in ANSWERS[self.file.task]}

    def takes(self, answer: str) -> bool:
        """Whether it is an answer of the task."""
        return answer in self.answers if self.answers else bool(_NUMBER.fullmatch(answer)) and float(answer) > 0

    @property
    def in_newtons(self) -> bool:
        """Whether the variable is a felt quantity."""
        return self.file.stimulus.variable in QUANTITIES

    @property
    def quantity(self) -> str:
        """The attribute of Felt in which the stimuli differ: the variable itself, or what is judged."""
        return QUANTITIES.get(self.file.stimulus.variable, self.file.stimulus.judged)

    @cached_property
    def compares(self) -> bool:
        """Whether the answer that counts is "the comparison", not a right one: levels on both sides of a reference."""
        reference = self.reference
        return (
            self.file.task == "two_intervals"
            and reference is not None
            and min(self.levels) < reference < max(self.levels)
        )

    def judged(self, one: Stimulus) -> float:
        """What an observer judges, as a hand without tremor feels it."""
        return float(getattr(one.felt, self.file.stimulus.judged))

    @cached_property
    def rises(self) -> bool:
        """Whether the judged quantity grows with the level."""
        return self.judged(self.stimuli[-1]) >= self.judged(self.stimuli[0])

    @cached_property
    def shape(self) -> Shape:
        """Of the psychometric function."""
        if self.file.task == "yes_no" or self.compares:
            return Shape(rises=self.rises, bends=min(self.levels) > 0, rest="bias" if self.compares else "floor")
        grows = self.difference(len(self.stimuli) - 1) >= self.difference(0) or self.reference is not None
        none = self.reference or 0.0  # the level at which nothing differs; 0 if the intervals differ in the solver
        below = self.levels[0] < none
        rest: Literal["", "bias"] = "bias" if self.intervals == 2 else ""
        bends = self.reference is None
        return Shape(self.intervals, one_sided=True, rises=grows, reference=none, below=below, bends=bends, rest=rest)

    @cached_property
    def easiest(self) -> int:
        """The index of the level that is told best."""
        if self.intervals == 1:
            return len(self.stimuli) - 1 if self.rises else 0
        return max(range(len(self.stimuli)), key=lambda i: self.difference(i))

    def difference(self, i: int) -> float:
        """How much of the judged quantity level i differs by from its reference."""
        return abs(self.judged(self.stimuli[i]) - (self.judged(self.references[i]) if self.references else 0.0))

    @property
    def consented(self) -> str:
        """What a participant has read and answered who agreed; empty if nothing was asked."""
        words = self.file.words
        return self.file.consent and f"{self.file.consent} {words.agree} {words.yes}"

    @property
    def digest(self) -> str:
        """What the order of the trials and the stimuli depend on.

        A solved number is left out: its last digits differ between processors.
        """
        given, scenes = self.file.stimulus, [one.scene for one in self.stimuli]
        if self.in_newtons:
            scenes = [scenes[0].with_values({str(given.solve): float((given.between or (0.0,))[0])})]
        text = repr((self.file.model_dump(exclude={"title", "source", "words"}), scenes))
        return hashlib.sha256(text.encode()).hexdigest()[:16]
