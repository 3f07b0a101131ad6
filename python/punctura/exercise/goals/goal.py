"""The base of all goals, and their judges: a limit holds until missed, an achievement is open until met."""

from collections.abc import Iterator
from typing import Any, ClassVar, NamedTuple, Protocol, TypeAlias

import numpy as np

from punctura import Scene
from punctura.errors import Problem
from punctura.events import Event
from punctura.exercise.fields import Space, Start, Word
from punctura.exercise.motion import Gaps
from punctura.exercise.result import Remark
from punctura.exercise.seen import Seen
from punctura.exercise.ticks import Flags, JudgedTicks, Moment, TargetSpace, by, first_of
from punctura.files.tables import Table


class SoFar(Protocol):
    """What a sentence about a goal uses of the attempt's measures."""

    entries: int
    arrival: float | None  # s
    longest_stay: float  # s


class Judge:
    """Judges one goal of an attempt, and has the sentences about it."""

    def __init__(self, text: str) -> None:
        self.text = text

    def alarm(self, space: TargetSpace) -> str:
        """The instruction while the goal cannot be met any more, or only if the person acts at once; or empty."""
        return ""

    def corrections(self, seen: Seen) -> Iterator[Remark]:
        """What to change: of a limit that decided the attempt, and of an achievement."""
        yield from ()

    def praise(self, seen: Seen) -> Iterator[Remark]:
        """What went well: of a limit that was measured and kept."""
        yield from ()

    def advice(self, seen: Seen) -> Iterator[Remark]:
        """What could be better, although it decided nothing: of a limit, whatever its state."""
        yield from ()


class LimitJudge(Judge):
    """A goal that holds until it is missed. It is met only if it was measured to the end."""

    time_limit: float | None = None  # s from the first contact
    overshoot: tuple[int, float] | None = None  # a membrane, and the time after its pop in which it is measured, s
    after_yield: float | None = None  # s after the plunger gives way in which the injected volume is measured
    subjects: tuple[str, ...] = ()  # what the coach praises only if this goal was kept, as in Remark.about

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.missed: Moment | None = None
        self.unseen: Moment | None = None  # when needed readings had been missing, or late, for too long
        self.gone: Moment | None = None  # when a needed hand was that of a page that had been silent for too long
        self.busy: Flags | None = None  # the ticks of the batch in which a measurement is open
        self.waits_for = ""  # the end of an open measurement at the last tick: "pop", "rest" or "thumb"
        self._gaps = Gaps()

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        """Takes the next ticks of the attempt and their events."""
        raise NotImplementedError

    def measured(self, until: Moment | None) -> bool:
        """Whether the readings up to `until` are enough to call it met."""
        return not by(self.unseen, until) and not by(self.gone, until)

    def state(self, until: Moment | None, complete: bool) -> str:
        """open, met, missed or not measured, at `until`. complete: nothing more will be measured."""
        if by(self.missed, until):
            return "missed"
        if not complete:
            return "open"
        return "met" if self.measured(until) else "not measured"

    def why_missed(self, when: Moment, so_far: SoFar, space: TargetSpace) -> str:
        raise NotImplementedError

    def why_not_measured(self, until: Moment | None, first: str) -> str:
        """The reason, if no readings were missing. first: name of the first membrane."""
        if by(self.gone, until):
            return f"Not measured: “{self.text}”, because the page was late then, so that nobody moved the needle."
        return self.never_measured(first)

    def never_measured(self, first: str) -> str:
        return f"Not measured: “{self.text}”, because there was no contact with the {first}."

    def aiming(self, inside: bool) -> str:
        """The instruction while the needle points beside the goal, or empty. inside: it is in tissue."""
        return ""

    def waiting(self) -> str:
        """The instruction while it is still being measured, or empty."""
        return ""

    def _miss(self, ticks: JudgedTicks, flags: Flags) -> None:
        if self.missed is None:
            self.missed = first_of(ticks, flags)

    def _watch(self, ticks: JudgedTicks, seen: Flags, matters: Flags) -> None:
        """Notes missing readings. seen: a tick has a reading. matters: it can change what is judged."""
        self._lack(ticks, self._gaps.add(ticks, seen, matters))

    def _lack(self, ticks: JudgedTicks, flags: Flags) -> None:
        if self.unseen is None:
            self.unseen = first_of(ticks, flags)


class BegunJudge(LimitJudge):
    """A limit that is measured from a moment of the attempt on, such as the first contact."""

    began: Moment | None = None

    def measured(self, until: Moment | None) -> bool:
        return by(self.began, until) and super().measured(until)


class WindowJudge(LimitJudge):
    """A limit that is measured in a window of time. It is met at the end of the first window."""

    met: Moment | None = None  # the end of the first window

    def measured(self, until: Moment | None) -> bool:
        return by(self.met, until) and super().measured(until)

    def state(self, until: Moment | None, complete: bool) -> str:
        state = super().state(until, complete)
        return "met" if state == "open" and self.measured(until) else state


class Achievement(Judge):
    """Met at a tick. Open again if the needle leaves the space while a limit is still being measured."""

    seconds = 0.0  # to hold, s
    held = 0.0  # s, so far

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.met: Moment | None = None
        self.left = False  # it was met and is open again
        self.done = np.zeros(0, dtype=np.bool_)  # the ticks of the batch in which it is met

    def add(self, ticks: JudgedTicks, busy: Flags) -> None:
        """Takes the next ticks. busy: the ticks in which a limit is still being measured."""
        raise NotImplementedError

    def state(self, until: Moment | None) -> str:
        """ "open" or "met". until: the state at that moment."""
        return "met" if by(self.met, until) else "open"

    def instruction(self, arrived: bool, first: str, pop: str) -> str:
        """What to do while it is open. first: the exercise's instruction; pop: that of a limit that waits for one."""
        return f"{self.text}."

    def why_open(self, so_far: SoFar, space: TargetSpace) -> str:
        """The reason why it is still open at the end, although the needle was in the space."""
        return f"You left {space.name} before everything was measured." if self.left else f"Not done: {self.text}."

    def _follow(self, ticks: JudgedTicks, good: Flags, here: Flags, busy: Flags) -> None:
        rows = np.arange(len(ticks))
        met = np.maximum.accumulate(np.where(good, rows, -1 if self.met else -3))
        gone = np.maximum.accumulate(np.where(~here & busy, rows, -2))
        self.done = met > gone
        self.left = not self.done[-1] and (self.left or self.met is not None or bool(good.any()))
        if not self.done[-1]:
            self.met = None
        elif self.met is None or gone[-1] >= 0:
            self.met = first_of(ticks, good & (rows > gone[-1]))


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
