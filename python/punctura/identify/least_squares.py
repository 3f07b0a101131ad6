"""Nonlinear least squares within bounds, for models of few parameters that are asked many thousand times."""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

POOR, GOOD = 0.25, 0.75  # shares of the promised gain: then the trust region shrinks, or grows
FLAT = 1e-14  # of the greatest eigenvalue: a direction without effect
NEAREST = 1e-12  # to a bound
SHORT = 0.995  # of the way to a bound, that a step goes at most


def least_squares(
    residuals: Callable[[Array], Array],
    jacobian: Callable[[Array], Array],
    start: Array,
    bounds: tuple[Array, Array],
    gain: float,
    step: float,
    evaluations: int,
) -> tuple[Array, int, bool]:
    """The coordinates of the least squares from `start`, the number of evaluations, and whether the search ended.

    Steps are those of Gauss and Newton within a trust region. Its axes are the lengths of the derivatives (Moré 1978),
    and longer where the search nears a bound (Coleman and Li 1996), so that it does not run into it. The search ends
    where the squares fall by less than the share `gain`, or the coordinates move by less than the share `step`.
    """
    low, high = bounds
    at = np.clip(start, low, high)
    left = residuals(at)
    squares, lengths, radius, count = float(left @ left), np.zeros(len(at)), 0.0, 1
    while True:
        by_at = jacobian(at)
        with np.errstate(over="ignore", invalid="ignore"):
            slope, gram = by_at.T @ left, by_at.T @ by_at
        if not np.isfinite(gram).all():  # far from the data, a steep grip overflows
            return at, count, False
        lengths = np.maximum(lengths, np.sqrt(np.diag(gram)))
        axes, bent = _axes(np.where(lengths > 0, lengths, 1.0), slope, at, low, high)
        values, vectors = np.linalg.eigh(gram / np.outer(axes, axes) + np.diag(bent))
        if values[-1] <= 0:
            return at, count, True
        values = np.maximum(values, FLAT * values[-1])
        downhill = -vectors.T @ (slope / axes)
        radius = radius or _length(at * axes) or 1.0
        less = 0.0
        while not less > 0:
            if count >= evaluations:
                return at, count, False
            far = _within(values, downhill, radius)
            trial = np.clip(at + vectors @ far / axes, at + SHORT * (low - at), at + SHORT * (high - at))
            if not np.isfinite(trial).all():  # the slope or a length overflows
                return at, count, False
            move = trial - at
            promised = -float(2 * slope @ move + move @ gram @ move)
            tried, count = residuals(trial), count + 1
            less = squares - float(tried @ tried)
            share = less / promised if promised > 0 else 0.0
            ended = _length(move) < step * (step + _length(at))
            ended = ended or (abs(less) < gain * squares and share > POOR)
            if not share >= POOR:
                radius = POOR * min(radius, _length(move * axes) or radius)
            elif share > GOOD and _length(far) > 0.95 * radius:
                radius *= 2
            if less > 0:
                at, left, squares = trial, tried, squares - less
            if ended:
                return at, count, True


def _axes(lengths: Array, slope: Array, at: Array, low: Array, high: Array) -> tuple[Array, Array]:
    """The lengths of the derivatives, longer towards a bound that is near, and how much the bounds bend the squares."""
    room = np.where(slope < 0, high - at, at - low)
    bounded = np.isfinite(room)
    room = np.where(bounded, np.maximum(room, NEAREST) * lengths, 1.0)
    return lengths / np.sqrt(room), np.where(bounded, np.abs(slope) / lengths, 0.0)


def _within(values: Array, downhill: Array, radius: float) -> Array:
    """The Gauss-Newton step along the eigenvectors, damped so that it ends within the radius, to about 10 %."""
    step, damping = downhill / values, 0.0
    for _ in range(10):  # Newton's method for 1 / |step| = 1 / radius
        size = _length(step)
        if size <= radius or size - radius < 0.1 * radius:
            break
        slope = float(np.sum(step**2 / (values + damping)))
        damping += size**2 / slope * (size - radius) / radius
        step = downhill / (values + damping)
    return np.asarray(step * min(1.0, radius / max(_length(step), 1e-300)))


def _length(of: Array) -> float:
    return sqrt(float(of @ of))
