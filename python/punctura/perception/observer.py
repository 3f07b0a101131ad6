"""Simulated observers: they judge the felt force of a simulated hand, with noise that is known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.special import ndtr, ndtri

from punctura.perception.course import Course, Line, Trial, line_of
from punctura.perception.protocol import Protocol, Stimulus
from punctura.perception.psychometric import Array, strongest
from punctura.perception.session import Session
from punctura.perception.stimulus import Felt, simulated


@dataclass(frozen=True)
class Observer:
    """How a simulated person judges. Each interval is felt as its judged quantity plus normal noise.

    Its standard deviation is that of `noise` and of `weber` times the quantity, together. The interval that is felt as
    the strongest is chosen; "yes" if it is felt as more than `criterion`. Without a `criterion` it is half of the
    easiest level's. A rating has one more point for each `criterion`, by default an eighth.
    """

    weber: float = 0.1
    noise: float = 0.0  # N
    bias: float = 0.0  # N, added to the first of several intervals
    lapse: float = 0.02  # share of answers by chance
    criterion: float | None = None  # N

    def __post_init__(self) -> None:
        """Raises ValueError."""
        for key, most in (("weber", 1e6), ("noise", 1e6), ("lapse", 1.0)):
            if not 0 <= getattr(self, key) <= most:
                raise ValueError(f"{key} must be from 0 to {most:g}, not {getattr(self, key):g}")
        if not self.weber + self.noise > 0:
            raise ValueError("give weber or noise: without either there is no threshold")
        if not np.isfinite([self.bias, self.criterion or 0.0]).all():
            raise ValueError("bias and criterion must be finite numbers")


class Senses:
    """What is felt of each stimulus of a protocol, with several seeds of the hand; each computed once."""

    def __init__(self, protocol: Protocol, hands: int = 16) -> None:
        """hands: the more, the better is known what is known: to 3 % with 8, to 0.7 % with 64 (right answers)."""
        self.protocol, self.hands = protocol, hands
        self.known: dict[int, list[Felt]] = {}  # by the id of the stimulus

    def __call__(self, stimulus: Stimulus) -> list[Felt]:
        key, membrane = id(stimulus), self.protocol.membrane
        if key not in self.known:
            self.known[key] = [simulated(stimulus.scene, membrane, seed) for seed in range(self.hands)]
        return self.known[key]


class Simulation:
    """An observer in the sessions of a protocol."""

    def __init__(self, protocol: Protocol, observer: Observer, senses: Senses | None = None) -> None:
        self.protocol, self.observer = protocol, observer
        self.senses = senses or Senses(protocol)
        self._judged = protocol.file.stimulus.judged

    def __repr__(self) -> str:
        return f"<Simulation of {self.protocol.name} by {self.observer}>"

    def answer(self, trial: Trial, seed: int) -> tuple[str, list[Felt]]:
        """The answer, and what was felt in each interval. The same seed and trial give the same answer."""
        random = np.random.default_rng([seed, trial.number])
        felt = [self.senses(one)[int(random.integers(self.senses.hands))] for one in trial.intervals]
        names = list(self.protocol.answers)
        if random.random() < self.observer.lapse and names:
            return names[int(random.integers(len(names)))], felt
        judged, spread = self._judged_of(felt)
        inner = judged + spread * random.standard_normal(len(felt))
        inner[0] += self.observer.bias * (len(inner) > 1)
        if self.protocol.file.task == "magnitude":
            return f"{np.clip(inner[0] / self.criterion, 0.01, 1e6):.2f}", felt
        if self.protocol.rates:
            return names[int(np.clip(round(inner[0] / self.criterion), 0, len(names) - 1))], felt
        if self.protocol.file.task == "yes_no":
            return names[0 if inner[0] > self.criterion else 1], felt
        if self.protocol.adjusts:
            gap, near = inner[1] - inner[0], spread[0] / 2
            ends = (trial.level == 0) == self.protocol.rises, trial.level in (0, len(self.protocol.levels) - 1)
            beyond = ends[1] and (gap > 0) == ends[0]  # there is no weaker or no stronger level
            return names[2 if abs(gap) < near or beyond else 0 if gap > 0 else 1], felt
        sign = self._sign(trial.shown, trial.intervals[trial.position - 1])  # an interval of the reference
        return names[int(np.argmax(sign * inner))], felt

    def _judged_of(self, several: Sequence[Felt]) -> tuple[Array, Array]:
        """What is judged of each, and the standard deviation of what is felt of it."""
        judged = np.array([float(getattr(one, self._judged)) for one in several])
        return judged, np.hypot(self.observer.noise, self.observer.weber * judged)

    def _sign(self, shown: Stimulus, other: Stimulus) -> int:
        """1 if the question seeks the strongest interval; -1 for the weakest: the levels only weaken the reference."""
        weaker = self.protocol.judged(shown) < self.protocol.judged(other)
        return -1 if weaker and not self.protocol.compares else 1

    @cached_property
    def criterion(self) -> float:
        """Above which a yes is given, or the step between two ratings; N."""
        if self.observer.criterion is not None:
            return self.observer.criterion
        most = self.protocol.judged(self.protocol.stimuli[self.protocol.easiest])
        return most / (8 if self.protocol.rates else 2)

    def run(self, participant: int, seed: int) -> list[Line]:
        """The lines of a whole session, without a file."""
        course, lines = Course(self.protocol, participant), list[Line]()
        while (trial := course.next()) is not None:
            answer, felt = self.answer(trial, seed)
            lines.append(line_of(trial, answer, felt))
            course.add(trial, answer)
        return lines

    def run_on_disk(self, folder: Path, participant: str, seed: int) -> int:
        """A session in a folder, or the rest of one. Returns the number of its trials. Raises SessionError."""
        with Session(self.protocol, folder, participant, consent=True, simulated=True) as session:
            while (trial := session.next()) is not None:
                session.add(trial, *self.answer(trial, seed))
            return len(session.course)

    def chance(
        self, shown: Stimulus, other: Stimulus | None, side: int = 0, lapses: bool = False, mean: bool = False
    ) -> float:
        """Of the counted answer, mean of the hand's realisations. side: 1, `shown` comes first; -1, it comes second; 0
        is for an observer without bias. mean: if a hand felt the mean of its realisations each time."""
        felt = (lambda one: [self._mean(one)]) if mean else self.senses
        a, sa = self._judged_of(felt(shown))
        if other is None:
            p = ndtr((a - self.criterion) / sa)
        else:
            b, sb = self._judged_of(felt(other))
            gap = self._sign(shown, other) * (a[:, None] - b + side * self.observer.bias)
            own, others = (np.broadcast_to(one, gap.shape) for one in (sa[:, None], sb))
            p = strongest(gap, own, others, self.protocol.intervals)
        lapse = self.observer.lapse * lapses
        return float((1 - lapse) * p.mean() + lapse / max(self.protocol.intervals, 2))

    def dprime(self, i: int) -> float:
        """What endless answers at level i would give, lapses included; NaN if a session like this one leaves less than
        half an answer of a kind to expect, so that no rule can know it."""
        protocol, shown, given = self.protocol, self.protocol.stimuli[i], self.protocol.file.trials
        counts = [(given.per_level or 0) / 2] * 2
        if protocol.catch is not None and protocol.file.task == "yes_no":
            rates = np.array([self.chance(shown, None, 0, True), 1 - self.chance(protocol.catch, None, 0, True)])
            counts = [given.per_level or 0, given.catch * given.blocks]
        else:
            rates = np.array([self.chance(shown, protocol.references[i], side, True) for side in (1, -1)])
        known = (counts * np.minimum(rates, 1 - rates)).min() >= 0.5
        return float(ndtri(rates).sum() / np.sqrt(protocol.intervals)) if known else np.nan

    def curve(self) -> tuple[Array, Array]:
        """Levels, and the probability of the counted answer at each, without lapses and bias.

        With a felt quantity the level is the felt one: a hand feels the planned level differently each time.
        """
        protocol = self.protocol
        pairs = list(zip(protocol.stimuli, protocol.references or [None] * len(protocol.stimuli), strict=True))
        if not protocol.in_newtons:
            return np.array(protocol.levels), np.array([self.chance(*pair) for pair in pairs])
        x = []
        for shown, other in pairs:
            less = getattr(self._mean(other), protocol.quantity) - (protocol.reference or 0.0) if other else 0.0
            x.append(getattr(self._mean(shown), protocol.quantity) - less)
        return np.array(x), np.array([self.chance(*pair, mean=True) for pair in pairs])

    def _mean(self, stimulus: Stimulus) -> Felt:
        several = [vars(one) for one in self.senses(stimulus)]
        return Felt(**{key: type(value)(np.mean([one[key] for one in several])) for key, value in several[0].items()})

    def threshold(self, share: float | None = None) -> float:
        """The level at which the counted answer has the probability `share`, without lapses; the true threshold.

        Default: 1/2, or half-way between guess and 1 for right answers. Raises ValueError if it is outside the levels.
        """
        from scipy.interpolate import PchipInterpolator  # takes long

        shape = self.protocol.shape
        wanted = share if share is not None else (1 + shape.guess) / 2 if shape.one_sided else 0.5
        levels, p = self.curve()
        z = ndtri(np.clip(p, 1e-9, 1 - 1e-9))  # between levels it is straighter than the probability
        found = PchipInterpolator(levels, z - ndtri(wanted)).roots(extrapolate=False)
        if not len(found):
            raise ValueError(f"this observer's threshold is outside the levels, {levels[0]:g} to {levels[-1]:g}")
        return abs(float(found[0]) - shape.reference) if shape.one_sided else float(found[0])

    def jnd(self) -> float:
        """Half the distance between 25 % and 75 %, or of right answers the threshold. Raises ValueError."""
        if self.protocol.shape.one_sided:
            return self.threshold()
        return abs(self.threshold(0.75) - self.threshold(0.25)) / 2
