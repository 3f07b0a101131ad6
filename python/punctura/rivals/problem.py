"""A rival's numbers as a vector between bounds, and the force that it gives for it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from punctura._core import Rival
from punctura.rivals.kinds import RivalKind, RivalNumber
from punctura.rivals.layers import Layer, Path, resistance
from punctura.rivals.starts import STARTS, Wall

Array = NDArray[np.float64]


class Problem:
    """A rival in each wall of a trace. x (p,) holds, for each wall, its surface and its fitted numbers, scaled.

    The puncture is no part of x: the force jumps there, so it has no derivative. It lies between two samples, and the
    fit tries the samples of the drop one after the other.
    """

    def __init__(self, kind: RivalKind, path: Path, walls: Sequence[Wall]) -> None:
        self.kind, self.path, self.walls = kind, path, tuple(walls)
        self._starts = [self._first(wall) for wall in walls]
        self._fitted = [self._visible(i) for i in range(len(walls))]
        first, low, high, scale = [], [], [], []
        for wall, start, fitted in zip(walls, self._starts, self._fitted, strict=True):
            reach = max(wall.seen.reach, 1e-6)
            rows = [(wall.surface, wall.lowest, wall.highest, reach)]
            rows += [(start[n.name], n.low, n.high, max(abs(start[n.name]), 1e-6 * n.high)) for n in fitted]
            for value, least, most, size in rows:
                first.append(value / size)
                low.append(least / size)
                high.append(most / size)
                scale.append(size)
        sizes = [1 + len(fitted) for fitted in self._fitted]
        self._at = [sum(sizes[:i]) for i in range(len(sizes))]  # of each wall in x
        self.low, self.high, self.scale = np.array(low), np.array(high), np.array(scale)
        self.first = self.inside(np.array(first))

    @property
    def parameters(self) -> int:
        """How many numbers are fitted, with the punctures."""
        punctures = sum(wall.punctured is not None for wall in self.walls) if self.kind.punctures else 0
        return len(self.first) + punctures

    def inside(self, x: Array) -> Array:
        """x moved between the bounds."""
        margin = 1e-9 * (self.high - self.low)
        moved: Array = np.clip(x, self.low + margin, self.high - margin)
        return moved

    def from_other(self, other: Problem, x: Array) -> Array:
        """The x of another problem of the same walls in the scale of this one; its own start where only this one fits.

        Of other samples, other numbers can be visible.
        """
        own = self.first.copy()
        for mine, at, theirs, start in zip(self._fitted, self._at, other._fitted, other._at, strict=True):
            places = {number.name: start + 1 + j for j, number in enumerate(theirs)}
            rows = [(at, start)] + [(at + 1 + j, places[n.name]) for j, n in enumerate(mine) if n.name in places]
            for to, source in rows:
                own[to] = x[source] * other.scale[source] / self.scale[to]
        return self.inside(own)

    def other_start(self, rng: np.random.Generator) -> Array:
        """A random start: numbers within a factor of about 2, surfaces anywhere between their bounds."""
        x = self.first * np.exp(0.7 * rng.standard_normal(len(self.first)))
        for at in self._at:
            x[at] = rng.uniform(self.low[at], self.high[at])
        return self.inside(x)

    def layers(self, x: Array, punctured: Sequence[int | None]) -> tuple[Layer, ...]:
        """The rivals for x. punctured: first sample behind the puncture of each wall."""
        return tuple(self._layer(i, x, punctured[i]) for i in range(len(self.walls)))

    def _layer(self, i: int, x: Array, punctured: int | None) -> Layer:
        at, fitted = self._at[i], self._fitted[i]
        numbers = dict(self._starts[i])
        for j, number in enumerate(fitted, at + 1):
            numbers[number.name] = float(np.clip(x[j] * self.scale[j], number.low, number.high))
        surface = float(x[at] * self.scale[at])
        return Layer(surface, self._punctured_at(numbers, surface, punctured))

    def force(self, x: Array, punctured: Sequence[int | None]) -> Array:
        """The force against the insertion (n,), N."""
        return resistance(self.layers(x, punctured), self.path)

    def slopes(self, x: Array, punctured: Sequence[int | None]) -> Array:
        """The derivatives of force() by x (n, p), by differences; each number moves only the force of its own wall."""
        columns = np.empty((len(self.path.depth), len(x)))
        for i, at in enumerate(self._at):
            plain = self._layer(i, x, punctured[i]).resistance(self.path)
            for j in range(at, at + 1 + len(self._fitted[i])):
                step = 1e-5 * max(abs(x[j]), 1e-2)
                moved = x.copy()
                moved[j] += step if x[j] + step < self.high[j] else -step
                columns[:, j] = (self._layer(i, moved, punctured[i]).resistance(self.path) - plain) / (moved[j] - x[j])
        return columns

    def _first(self, wall: Wall) -> dict[str, float]:
        start = {n.name: n.default for n in self.kind.numbers} | STARTS[self.kind.name](wall.seen)
        if "dead_band" in start:
            start["dead_band"] = self.path.slow()
        return {n.name: float(np.clip(start[n.name], n.low, n.high)) for n in self.kind.numbers}

    def _visible(self, i: int) -> tuple[RivalNumber, ...]:
        """The numbers that change the force along this path."""
        wall, start = self.walls[i], self._starts[i]
        plain = self._wall_force(start, wall)
        found = []
        for number in self.kind.fitted(self.path.shows):
            other = start[number.name] * 1.1 + 1e-3 * (start[number.name] == 0)
            changed = start | {number.name: min(other, number.high)}
            if np.any(self._wall_force(changed, wall) != plain):
                found.append(number)
        return tuple(found)

    def _wall_force(self, numbers: dict[str, float], wall: Wall) -> Array:
        return Layer(wall.surface, self._punctured_at(numbers, wall.surface, wall.punctured)).resistance(self.path)

    def _punctured_at(self, numbers: dict[str, float], surface: float, sample: int | None) -> Rival:
        rival = Rival(self.kind.name, numbers)
        if not self.kind.punctures:
            return rival
        limit = next(n for n in self.kind.numbers if n.name == "puncture")
        threshold = limit.high
        if sample is not None:
            path = self.path
            rows = slice(0, sample + 1)
            loads = rival.loads(path.depth[rows] - surface, path.velocity[rows], path.period[rows])
            before = float(loads[:-1].max(initial=0.0))
            threshold = 0.5 * (before + max(before, float(loads[-1])))
        return Rival(self.kind.name, numbers | {"puncture": float(np.clip(threshold, limit.low, limit.high))})
