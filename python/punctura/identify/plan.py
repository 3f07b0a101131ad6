"""The next experiment: the motion that makes a model's parameters visible, from the Fisher information."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise, product

import numpy as np
from numpy.typing import NDArray

from punctura.identify.fit import Misfit
from punctura.identify.parameters import Free, Parameters
from punctura.trace import Trace

Array = NDArray[np.float64]

RATE_HZ = 200.0
REST = 10.0  # s, a hold long enough for tissue to relax


@dataclass(frozen=True, eq=False)
class Plan:
    """A motion that a robot can follow. errors: expected standard error of each free parameter's coordinate."""

    name: str
    time: Array  # s
    depth: Array  # m
    errors: dict[str, float]
    score: float  # log of the determinant of the Fisher information; greater is better

    def csv(self) -> bytes:
        """time_s,depth_mm at 200 Hz."""
        rows = (f"{t:.4f},{d * 1e3:.5f}" for t, d in zip(self.time, self.depth, strict=True))
        return ("time_s,depth_mm\n" + "\n".join(rows) + "\n").encode()


def plans(
    parameters: Parameters, names: Sequence[str], deepest: float, noise: float, longest: float = 60.0
) -> list[Plan]:
    """Possible motions, the most informative first, all within `longest` s and `deepest` m. noise: of the force, N.

    The information is that of `names` (as in an Identification) at these parameters.
    """
    found = []
    for name, time, depth in _motions(parameters, deepest):
        if time[-1] > longest:
            continue
        score, errors = information(parameters, names, time, depth, noise)
        found.append(Plan(name, time, depth, errors, score))
    return sorted(found, key=lambda plan: -plan.score)


def information(
    parameters: Parameters, names: Sequence[str], time: Array, depth: Array, noise: float
) -> tuple[float, dict[str, float]]:
    """Log-determinant of the Fisher information of the free coordinates, and their expected standard errors."""
    free = Free(names, parameters)
    u = free.coordinates(parameters)
    jacobian = Misfit(Trace(depth, np.zeros(len(depth)), time), parameters).jacobian(free, u) / noise
    gram = jacobian.T @ jacobian + 1e-6 * np.eye(len(u))  # a weak prior: what is not seen has an error of 1000
    errors = np.sqrt(np.diag(np.linalg.inv(gram)))
    return float(np.linalg.slogdet(gram)[1]), dict(zip(names, errors.tolist(), strict=True))


def _motions(parameters: Parameters, deepest: float) -> list[tuple[str, Array, Array]]:
    """In and out at several speeds, with holds, reversals on the way, and a second insertion."""
    surface = float(parameters.membranes[:, 0].min())
    before = surface - min(2e-3, 0.2 * max(deepest - surface, 1e-3))
    half = surface + 0.5 * (deepest - surface)
    found = []
    for speed, hold, back, times in product((2e-3, 5e-3, 10e-3), (0.0, REST), (False, True), (1, 2)):
        stops = [(before, 0.0)]
        stops += [(half, 0.0), (half - 0.3 * (half - surface), 0.0)] if back else []
        stops += [(deepest, hold), (before, 0.0)] + [(deepest, 0.0), (before, 0.0)] * (times - 1)
        words = [f"{speed * 1e3:g} mm/s"]
        words += [f"a rest of {hold:g} s"] if hold else []
        words += ["a reversal half way"] if back else []
        words += ["a second insertion"] if times == 2 else []
        found.append((", ".join(words), *_follow(stops, speed)))
    return found


def _follow(stops: Sequence[tuple[float, float]], speed: float) -> tuple[Array, Array]:
    """Time and depth along stops (depth m, rest s), at RATE_HZ."""
    times, depths = [0.0], [stops[0][0]]
    for (a, _), (b, rest) in pairwise(stops):
        times.append(times[-1] + abs(b - a) / speed)
        depths.append(b)
        if rest > 0:
            times.append(times[-1] + rest)
            depths.append(b)
    time = np.arange(int(times[-1] * RATE_HZ) + 1) / RATE_HZ
    return time, np.interp(time, times, depths)
