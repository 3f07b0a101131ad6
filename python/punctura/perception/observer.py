"""Simulated observers: they judge the felt force of a simulated hand, with noise that is known."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.special import ndtr

from punctura.perception.course import Course, Trial
from punctura.perception.protocol import Protocol, Stimulus
from punctura.perception.session import Session
from punctura.perception.stimulus import Felt, simulated

REALISATIONS = 8  # of the hand's randomness, for each stimulus


@dataclass(frozen=True)
class Observer:
    """How a simulated person judges. Each interval is felt as its judged quantity plus normal noise.

    Its standard deviation is that of `noise`, `weber` times the quantity and `masking` times the largest force of the
    interval, together. The interval that is felt as the strongest is chosen; "yes" if it is felt as more than
    `criterion`. Without a `criterion` it is half of the easiest level's. A rating has one more point for each
    `criterion`, by default an eighth.
    """

    weber: float = 0.1
    noise: float = 0.0  # N
    masking: float = 0.0
    bias: float = 0.0  # N, added to the comparison
    lapse: float = 0.02  # share of answers by chance
    criterion: float | None = None  # N

    def __post_init__(self) -> None:
        """Raises ValueError."""
        for key in ("weber", "noise", "masking"):
            if not 0 <= getattr(self, key) < np.inf:
                raise ValueError(f"{key} must be 0 or more, not {getattr(self, key):g}")
        if not 0 <= self.lapse <= 1:
            raise ValueError(f"lapse must be from 0 to 1, not {self.lapse:g}")
        if not self.weber + self.noise + self.masking > 0:
            raise ValueError("give at least one of weber, noise and masking: without noise there is no threshold")
        if not np.isfinite([self.bias, self.criterion or 0.0]).all():
            raise ValueError("bias and criterion must be finite numbers")

    def spread(self, one: Felt, judged: str) -> float:
        return float(np.hypot(np.hypot(self.noise, self.weber * getattr(one, judged)), self.masking * one.peak))


class Senses:
    """What is felt of each stimulus of a protocol, several times with another seed of the hand; each computed once."""

    def __init__(self, protocol: Protocol) -> None:
        self.protocol = protocol
        self._felt: dict[int, list[Felt]] = {}

    def felt(self, stimulus: Stimulus, random: np.random.Generator) -> Felt:
        """One realisation."""
        return self.all(stimulus)[int(random.integers(REALISATIONS))]

    def all(self, stimulus: Stimulus) -> list[Felt]:
        """All realisations."""
        key = id(stimulus)
        if key not in self._felt:
            membrane = self.protocol.membrane
            self._felt[key] = [simulated(stimulus.scene, membrane, seed) for seed in range(REALISATIONS)]
        return self._felt[key]


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
        felt = [self.senses.felt(one, random) for one in trial.intervals]
        names = list(self.protocol.answers)
        if random.random() < self.observer.lapse:
            return names[int(random.integers(len(names)))], felt
        inner = [self._inner(one, random, i == trial.position) for i, one in enumerate(felt)]
        if self.protocol.rates:
            return names[int(np.clip(round(inner[0] / self.criterion), 0, len(names) - 1))], felt
        if self.protocol.file.task == "yes_no":
            return names[0 if inner[0] > self.criterion else 1], felt
        return names[int(np.argmax(inner) if self._stronger(trial) else np.argmin(inner))], felt

    def _inner(self, one: Felt, random: np.random.Generator, is_comparison: bool) -> float:
        value = float(getattr(one, self._judged)) + self.observer.bias * is_comparison
        return value + self.observer.spread(one, self._judged) * float(random.standard_normal())

    def _stronger(self, trial: Trial) -> bool:
        """Whether the question seeks the strongest interval; the weakest if the levels only weaken the reference."""
        if self.protocol.compares:
            return True
        other = trial.intervals[trial.position - 1]  # an interval of the reference
        return bool(getattr(trial.shown.felt, self._judged) >= getattr(other.felt, self._judged))

    @cached_property
    def criterion(self) -> float:
        """Above which a yes is given, or the step between two ratings; N."""
        if self.observer.criterion is not None:
            return self.observer.criterion
        most = float(getattr(self.protocol.stimuli[self.protocol.easiest].felt, self._judged))
        return most / (8 if self.protocol.rates else 2)

    def run(self, participant: int, seed: int) -> list[dict[str, object]]:
        """The lines of a whole session, without a file."""
        course = Course(self.protocol, participant)
        lines: list[dict[str, object]] = []
        while (trial := course.next()) is not None:
            answer, felt = self.answer(trial, seed)
            lines.append(
                {"kind": trial.kind, "block": trial.block, "level": trial.shown.level, "position": trial.position,
                 "answer": answer, "felt": [vars(one) for one in felt]}
            )  # fmt: skip
            course.add(trial, answer)
        return lines

    def run_on_disk(self, folder: Path, participant: str, seed: int) -> int:
        """A session in a folder, or the rest of one. Returns the number of its trials. Raises SessionError."""
        with Session(self.protocol, folder, participant, consent=True, simulated=True) as session:
            while (trial := session.next()) is not None:
                session.add(trial, *self.answer(trial, seed))
            return len(session.course)

    def probability(self, i: int) -> float:
        """Of the counted answer at level i, without lapses: the mean over the hand's realisations."""
        stimulus, protocol = self.protocol.stimuli[i], self.protocol
        mine = self.senses.all(stimulus)
        a = np.array([getattr(one, self._judged) for one in mine]) + self.observer.bias
        sa = np.array([self.observer.spread(one, self._judged) for one in mine])
        if protocol.file.task == "yes_no":
            return float(ndtr((a - self.criterion) / sa).mean())
        others = self.senses.all(protocol.references[i])
        b = np.array([getattr(one, self._judged) for one in others])
        sb = np.array([self.observer.spread(one, self._judged) for one in others])
        gap = a.mean() - b.mean()
        if not protocol.compares:
            gap = abs(gap)
        return _chosen(gap, float(sa.mean()), float(sb.mean()), protocol.intervals)

    def threshold(self, share: float | None = None) -> float:
        """The level at which the counted answer has the probability `share`, without lapses; the true threshold.

        Default: 1/2, or half-way between guess and 1 for right answers. Raises ValueError if it is outside the levels.
        """
        shape = self.protocol.shape
        wanted = share if share is not None else (1 + shape.guess) / 2 if shape.one_sided else 0.5
        from scipy.interpolate import PchipInterpolator  # takes long

        p = np.array([self.probability(i) for i in range(len(self.protocol.levels))])
        levels = np.asarray(self.protocol.levels)
        curve = PchipInterpolator(levels, p - wanted)
        found = curve.roots(extrapolate=False)
        if not len(found):
            raise ValueError(f"this observer's threshold is outside the levels, {levels[0]:g} to {levels[-1]:g}")
        return abs(float(found[0]) - shape.reference) if shape.one_sided else float(found[0])


def _chosen(gap: float, own: float, other: float, intervals: int) -> float:
    """The probability that the comparison is felt strongest of all intervals."""
    if intervals == 2:
        return float(ndtr(gap / np.hypot(own, other)))
    z = np.linspace(-8, 8, 801)
    density = np.exp(-z * z / 2) / np.sqrt(2 * np.pi)
    beats = ndtr((gap + own * z) / other) ** (intervals - 1)
    return float(np.sum(density * beats) * (z[1] - z[0]))
