"""The depth without its noise. A model follows every depth, so noise of the depth becomes force, by the spring."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from punctura.identify.noise import effective_samples
from punctura.trace import Trace
from punctura.trace.turns import noise_of

Array = NDArray[np.float64]

DRAWS, NUMBERS, FEWEST_DRAWS = 64, 4_000_000, 8  # of the true depth: so many, with so many numbers at most
ROUNDS, NEAR = 10, 11  # of the accelerations; second differences of alike variance, in samples
SHARED = (0.2, 0.6, 0.2)  # of the square of a second difference, with its neighbours: a turn is between two samples
LEAST, MOST = 1e-7, 1e4  # variance of a second difference, in those of the noise
FELT = 0.2  # of the noise of the force: what the noise of the depth adds matters beyond it
ROUNDING = 1e-6  # of the range of the depths: less is no noise
EVEN = 1.5  # times the shortest step of time, of the longest one
HAND = 12.0  # Hz: a hand does not shake faster
ALIKE = 2.0  # times the noise of every second sample, and the reverse
SHORTEST = 50  # samples of a trace
WHITE = 0.8  # of the samples are independent: they are noise
SURE = 5.0  # over sqrt(n): a greater correlation of second differences is no chance; its deviation is about 1.4


def with_quiet_depth(trace: Trace, noise: float | None = None) -> tuple[Trace, float]:
    """The trace with the depth that the needle most likely had, and with draws of it: `trace.depths`; and the noise.

    noise: of a depth, m; None: as the samples show it, if they do. The same trace and 0 come back where
    the noise adds too little force to matter, and where the force follows the depth's noise: then the needle moved so.
    A quiet trace comes back as it is.
    """
    if trace.depths is not None:
        return trace, 0.0
    shaking = _noise(trace) if noise is None else noise
    if len(trace) < SHORTEST or not _matters(trace, shaking):
        return trace, 0.0
    quiet, variances = _quiet(trace.depth / shaking)
    if noise is None and _follows(trace, trace.depth - shaking * quiet):
        return trace, 0.0
    return replace(trace, depth=shaking * quiet, depths=shaking * (quiet + _draws(variances))), shaking


def noise_not_used(trace: Trace, noise: float | None) -> tuple[str, ...]:
    """Why a stated noise of the depth, m, is not taken out: the trace is too short. Nothing if it does not matter."""
    if noise is None or len(trace) >= SHORTEST or not _matters(trace, noise):
        return ()
    return (
        f"The stated noise of the depth, {noise:.3g} m, is not taken into account: that needs {SHORTEST} samples, and "
        f"the trace has {len(trace)}. The intervals may be too narrow.",
    )


def _matters(trace: Trace, noise: float) -> bool:
    """Whether this noise of the depth, m, adds force that shows beside the noise of the force."""
    rounding = noise <= ROUNDING * np.ptp(trace.depth)
    return not rounding and noise * _stiffest(trace) > FELT * noise_of(trace.force)


def _noise(trace: Trace) -> float:
    """The noise of the depth, m, where its samples, at even steps of time, are fast enough to tell it from a hand."""
    if trace.time is None:
        return 0.0
    steps = np.diff(trace.time)
    fast = steps.max() < EVEN * steps.min() and 4 * HAND * float(np.mean(steps)) <= 1
    return steady_noise(trace.depth) if fast else 0.0


def steady_noise(depth: Array) -> float:
    """The noise of a depth (n,), m, if every second sample shows the same one; otherwise it is motion: 0.

    In every second sample a motion at w radians a sample seems 2 (1 + cos w) times as large: more than ALIKE times
    below a quarter of the sample rate.
    """
    noise, thinned = noise_of(depth), noise_of(depth[::2])
    return noise if noise < ALIKE * thinned and thinned < ALIKE * noise else 0.0


def _stiffest(trace: Trace) -> float:
    """How fast the force changes over the depth, N/m: where the needle turns, the spring shows."""
    size = max(3, len(trace) // 200)
    ways, forces = (np.abs(column[size:] - column[:-size]) for column in (trace.depth, trace.force))
    far = ways > 0.1 * float(np.median(ways))
    return float(np.percentile(forces[far] / ways[far], 90)) if far.any() else 0.0


def _quiet(depth: Array) -> tuple[Array, Array]:
    """The most likely depth (n,), and the variance (n - 2,) of its second differences, all in units of the noise.

    A machine goes straight and turns sharply. If that leaves more than noise, a hand has moved the needle.
    """
    variances = _of_machine(depth)
    quiet = _solved(variances, depth)
    if effective_samples(depth - quiet) < WHITE * len(depth):
        variances = _of_hand(depth)
        quiet = _solved(variances, depth)
    return quiet, variances


def _of_machine(depth: Array) -> Array:
    """Variances (n - 2,) of the second differences where few are not 0.

    They have Student's t distribution with one degree of freedom, by reweighting (Lange, Little and Taylor 1989).
    """
    variances = np.full(len(depth) - 2, 0.25)
    for _ in range(ROUNDS):
        second = np.diff(_solved(variances, depth), 2)
        usual = max(1.5 * float(np.median(np.abs(second))), np.sqrt(LEAST))
        variances = 0.5 * (usual**2 + np.convolve(second**2, SHARED, "same"))
    return variances


def _of_hand(depth: Array) -> Array:
    """Variances (n - 2,) of the second differences where neighbours have about the same one.

    It is the most likely one, by MacKay's fixed point (MacKay 1992) with a local spectrum.
    """
    angles = np.linspace(0, np.pi, 1000)
    seen = (2 - 2 * np.cos(angles)) ** 2  # what white noise of the depth is in its second differences
    grid = np.geomspace(LEAST, MOST, 120)
    shares = np.array([np.mean(one / (one + seen)) for one in grid])  # of a variance, what the depth shows of it
    near = np.ones(NEAR) / NEAR
    variances = np.full(len(depth) - 2, 0.25)
    for _ in range(ROUNDS):
        second = np.diff(_solved(variances, depth), 2)
        share = np.interp(np.log(variances), np.log(grid), shares)
        variances = np.clip(np.convolve(second**2, near, "same") / np.convolve(share, near, "same"), LEAST, MOST)
    return variances


def _solved(variances: Array, columns: Array) -> Array:
    """(1 + D^T diag(variances)^-1 D)^-1 columns, D: second differences."""
    from scipy.linalg import solveh_banded

    shape = (1.0, -2.0, 1.0)
    upper = np.zeros((3, len(columns)))
    upper[2] = 1.0
    for i in range(3):
        for j in range(i, 3):
            upper[2 + i - j, j : j + len(variances)] += shape[i] * shape[j] / variances
    return np.asarray(solveh_banded(upper, columns))


def _draws(variances: Array) -> Array:
    """Draws (m, n) of what is wrong with the most likely depth, in units of the noise: the same in every run."""
    samples = len(variances) + 2
    rng = np.random.default_rng(0)
    count = int(np.clip(NUMBERS // samples, FEWEST_DRAWS, DRAWS))
    pushes = rng.normal(size=(samples, count))
    bent = rng.normal(size=(samples - 2, count)) / np.sqrt(variances)[:, None]
    pushes[:-2] += bent
    pushes[1:-1] -= 2 * bent
    pushes[2:] += bent
    return _solved(variances, pushes).T


def _follows(trace: Trace, left: Array) -> bool:
    """Whether the force follows what the quiet depth leaves (n,), m."""
    left, force = np.diff(left, 2), np.diff(trace.force, 2)
    size = float(np.sqrt((left @ left) * (force @ force)))
    return size > 0 and float(left @ force) / size > SURE / np.sqrt(len(left))
