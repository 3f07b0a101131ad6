"""The forces of the needles as a part of data.xfrc_applied, where MuJoCo's force sensors see them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from punctura.mujoco.frames import Array


class Applied:
    """Adds the forces of the needles to what the caller has put into data.xfrc_applied, and takes them away again."""

    def __init__(self, pairs: Sequence[tuple[int, int]]) -> None:
        """pairs: body of the needle, body of the tissue, for each link."""
        self._pairs = list(pairs)
        self._bodies = sorted({body for pair in pairs for body in pair} - {0})  # the world does not move
        self._given: Array | None = None
        self._written: Array | None = None

    def put(self, data: Any, points: Array, forces: Array) -> None:
        """Replaces the last forces of the needles. points, forces (L, 3): in the world, m and N, on the needles."""
        rows = data.xfrc_applied[self._bodies]
        if self._written is None or self._given is None or not np.array_equal(rows, self._written):
            self._given = rows
        written = self._given.copy()
        for bodies, point, force in zip(self._pairs, points, forces, strict=True):
            for body, sign in zip(bodies, (1, -1), strict=True):
                if body:
                    row = written[self._bodies.index(body)]
                    row[:3] += sign * force
                    row[3:] += sign * np.cross(point - data.xipos[body], force)
        data.xfrc_applied[self._bodies] = self._written = written

    def take_away(self, data: Any) -> None:
        """Leaves only what the caller has put there."""
        if (
            self._given is not None
            and self._written is not None
            and np.array_equal(data.xfrc_applied[self._bodies], self._written)
        ):
            data.xfrc_applied[self._bodies] = self._given
        self._given = self._written = None
