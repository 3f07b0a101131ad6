"""Measures how straight the tip's path is."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from punctura.exercise.ticks import Numbers

RULER = 0.5e-3  # m; shorter moves, from tremor and encoder steps, are not added up


class PathSoFar(NamedTuple):
    length: float  # m, in steps of RULER
    net: float  # m
    deviation: float  # m from the line of entry


class Path:
    """The tip's path from an entry to its deepest point so far."""

    def __init__(self, entry: Numbers, direction: Numbers) -> None:
        """entry: position, m. direction: of the needle, of length 1."""
        self._entry, self._direction = entry, direction
        self._anchor = entry
        self._length = self._deviation = 0.0
        self._deepest = 0.0
        self.deepest = PathSoFar(0.0, 0.0, 0.0)

    def add(self, tip: Numbers) -> None:
        """Takes the next positions of the tip, (n, 3), m."""
        tip = tip[np.isfinite(tip).all(axis=1)]
        if len(tip) == 0:
            return
        depth = (tip - self._entry) @ self._direction
        row = int(depth.argmax())
        if depth[row] > self._deepest:
            self._deepest = float(depth[row])
            self._walk(tip[: row + 1])
            self.deepest = self.at(tip[row])
            tip = tip[row + 1 :]
        self._walk(tip)

    def at(self, tip: Numbers) -> PathSoFar:
        """The path up to this position."""
        rest = float(np.linalg.norm(tip - self._anchor))
        return PathSoFar(self._length + rest, float(np.linalg.norm(tip - self._entry)), self._deviation)

    def _walk(self, tip: Numbers) -> None:
        if len(tip) == 0:
            return
        offset = tip - self._entry
        across = offset - np.outer(offset @ self._direction, self._direction)
        self._deviation = max(self._deviation, float(np.linalg.norm(across, axis=1).max()))
        while True:
            away = np.linalg.norm(tip - self._anchor, axis=1)
            step = int((away >= RULER).argmax())
            if away[step] < RULER:
                return
            self._length += float(away[step])
            self._anchor = tip[step]
            tip = tip[step:]
