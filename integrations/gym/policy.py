"""A hand that stops after a pop, and a hand that stops at a depth. Both have a few numbers that are learnt."""

from __future__ import annotations

import numpy as np
from punctura.gym import OBSERVATION

HIGHEST, LOWEST, FORCE, DEPTH = (
    OBSERVATION.index(name) for name in ("highest_force_N", "lowest_force_N", "force_N", "depth_mm")
)


def share(x: np.ndarray) -> np.ndarray:
    """Any number to 0 ... 1."""
    return 1 / (1 + np.exp(-x))


class StopsAfterPop:
    """Counts pops, each a rise of the force and then a fall, and stops after the last one that it waits for.

    Learnt, one row for each trial: speed before the last pop, fall of the force that counts as a pop (N), number of
    pops to wait for, seconds to draw back after it.
    """

    start = np.array([0.0, np.log(0.1), 1.5, -2.0])
    spread = np.array([1.0, 0.7, 1.0, 1.5])

    def __init__(self, numbers: np.ndarray) -> None:
        self.speed = share(numbers[:, 0])
        self.fall = np.exp(numbers[:, 1])
        self.pops = np.maximum(1, np.round(numbers[:, 2]))
        self.back = 0.5 * share(numbers[:, 3])
        self.forget(np.ones(len(numbers), bool))

    def forget(self, which: np.ndarray) -> None:
        """Begins a trial."""
        if which.all():
            self.count, self.turn, self.since = np.zeros((3, len(which)))
            self.rising = np.zeros(len(which), bool)
        for state in (self.count, self.turn, self.since):
            state[which] = 0
        self.rising[which] = False

    def act(self, seen: np.ndarray, period: float) -> np.ndarray:
        """(n, 1) seen: observations (n, 5). period: s from one action to the next."""
        felt = np.where(self.rising, seen[:, LOWEST], seen[:, HIGHEST])
        self.turn = np.where(
            self.rising, np.maximum(self.turn, seen[:, HIGHEST]), np.minimum(self.turn, seen[:, LOWEST])
        )
        turned = np.abs(felt - self.turn) > self.fall
        self.count += turned & self.rising
        self.turn = np.where(turned, felt, self.turn)
        self.rising ^= turned
        done = self.count >= self.pops
        self.since += done * period
        return np.where(done, np.where(self.since <= self.back, -self.speed, 0), self.speed)[:, None]


class StopsAtDepth:
    """Knows nothing of the force: it stops after a way along the needle. Learnt: speed, way (mm)."""

    start = np.array([0.0, 20.0])
    spread = np.array([1.0, 10.0])

    def __init__(self, numbers: np.ndarray) -> None:
        self.speed, self.way = share(numbers[:, 0]), numbers[:, 1]

    def forget(self, which: np.ndarray) -> None:
        """Begins a trial: nothing to forget."""

    def act(self, seen: np.ndarray, period: float) -> np.ndarray:
        """(n, 1) seen: observations (n, 5)."""
        return np.where(seen[:, DEPTH] < self.way, self.speed, 0)[:, None]
