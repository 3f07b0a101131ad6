"""The depth without its noise. A model follows every depth, so noise of the depth becomes force, by the spring."""

from __future__ import annotations

from dataclasses import replace
from math import comb

import numpy as np
from numpy.typing import NDArray

from punctura.identify.noise import effective_samples
from punctura.trace import Trace
from punctura.trace.steps import equal_runs, rounding
from punctura.trace.turns import noise_of

Array = NDArray[np.float64]

DRAWS, NUMBERS, FEWEST_DRAWS = 64, 4_000_000, 8  # of the true depth: so many, with so many numbers at most
ROUNDS, NEAR = 10, 11  # of the accelerations; second differences of alike variance, in samples
SHARED = (0.2, 0.6, 0.2)  # of the square of a second difference, with its neighbours: a turn is between two samples
LEAST, MOST = 1e-7, 1e4  # variance of a second difference, in those of the noise
FELT = 0.05  # of the noise of the force: what the noise of the depth adds matters beyond it
ROUNDING = 1e-6  # of the range of the depths: less is no noise
EVEN = 1.5  # times the shortest step of time, of the longest one
HAND = 12.0  # Hz: a hand does not shake faster
ORDER = 6  # of differences
ALIKE = 2.0  # times the noise of every second sample, and the reverse
TURNS, BENT = 20, 0.05  # second differences that are not 0, and their share: fewer are turns
MOSTLY = 0.9  # of all bending
ROUNDED, FAR, NOISIER = 2.6, 0.02, 3.0  # a rounding is at most 1.7 standard deviations, and seems at most 2.8 of noise
SHORTEST = 50  # samples of a trace
WHITE = 0.8  # of the samples are independent: they are noise
SURE = 5.0  # over sqrt(n): a greater correlation of second differences is no chance; its deviation is about 1.4


def with_quiet_depth(trace: Trace, noise: float | None = None) -> tuple[Trace, float]:
    """The trace with the depth that the needle most likely had, and with draws of it: `trace.depths`; and the noise.

    noise: of a depth, m; None: as the samples show it, if they do, and at least their rounding. The same trace and 0
    come back where the noise adds too little force to matter, and where the force follows the depth's noise: then the
    needle moved so. A quiet trace comes back as it is.
    """
    if trace.depths is not None or len(trace) < SHORTEST:
        return trace, 0.0
    shaking = noise or 0.0
    if noise is None and _fast(trace):
        shaking, rounded = steady_noise(trace.depth), rounding_noise(trace.depth)
        if shaking <= NOISIER * rounded and (found := _between_steps(trace, rounded)):
            return found, rounded
    if not _matters(trace, shaking):
        return trace, 0.0
    quiet, variances = _quiet(trace.depth / shaking)
    if noise is None and _follows(trace, trace.depth / shaking - quiet):
        return trace, 0.0
    return _drawn(trace, shaking, quiet, variances, np.ones(len(trace))), shaking


def _between_steps(trace: Trace, rounded: float) -> Trace | None:
    """The same for a depth with this rounding, m; None if it does not matter, or a hand has moved the needle."""
    if not _matters(trace, rounded):
        return None
    runs = np.diff(equal_runs(trace.depth))
    weights = np.repeat(1 / runs, runs)  # equal readings have one error
    quiet, variances = _straight(trace.depth / rounded, weights)
    left = trace.depth / rounded - quiet
    if np.mean(np.abs(left) > ROUNDED) > FAR or _follows(trace, left):
        return None
    return _drawn(trace, rounded, quiet, variances, weights)


def _drawn(trace: Trace, noise: float, quiet: Array, variances: Array, weights: Array) -> Trace:
    """The trace with a depth (n,), in units of the noise, m, and with draws of it."""
    return replace(trace, depth=noise * quiet, depths=noise * (quiet + _draws(variances, weights)))


def rounding_noise(depth: Array) -> float:
    """The standard deviation of the depth's rounding, m; 0 for a machine whose speed is a step a sample."""
    size = rounding(depth)
    bent = np.abs(np.diff(depth, 2)) > size
    return size if bent.sum() > max(TURNS, BENT * len(bent)) else 0.0


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
    fine = noise <= ROUNDING * np.ptp(trace.depth)
    return not fine and noise * _stiffest(trace) > FELT * noise_of(trace.force)


def _fast(trace: Trace) -> bool:
    """Whether the samples have even steps of time, short enough to tell noise from the motion of a hand."""
    if trace.time is None:
        return False
    steps = np.diff(trace.time)
    return bool(steps.max() < EVEN * steps.min() and 4 * HAND * float(np.mean(steps)) <= 1)


def steady_noise(depth: Array) -> float:
    """The noise of a depth (n,), m, if every second sample shows the same one; otherwise it is motion: 0.

    It is that of the differences of this ORDER, in which the tremor of a hand is small: a motion at w radians a sample
    seems (2 sin(w/2))^6 as large. In every second sample it seems (2 cos(w/2))^6 times as large: more than ALIKE times
    below 0.3 of the sample rate.
    """
    noise, thinned = _shaking(depth), _shaking(depth[::2])
    return noise if noise < ALIKE * thinned and thinned < ALIKE * noise else 0.0


def _shaking(depth: Array) -> float:
    """The standard deviation of white noise, m, that such differences of a depth (n,) have."""
    if len(depth) <= ORDER:
        return 0.0
    return float(1.4826 * np.median(np.abs(np.diff(depth, ORDER))) / np.sqrt(comb(2 * ORDER, ORDER)))


def _stiffest(trace: Trace) -> float:
    """How fast the force changes over the depth, N/m: where the needle turns, the spring shows."""
    size = max(3, len(trace) // 200)
    ways, forces = (np.abs(column[size:] - column[:-size]) for column in (trace.depth, trace.force))
    far = ways > 0.1 * float(np.median(ways))
    return float(np.percentile(forces[far] / ways[far], 90)) if far.any() else 0.0


def _quiet(depth: Array) -> tuple[Array, Array]:
    """The most likely depth (n,), and the variance (n - 2,) of its second differences, all in units of the noise.

    A machine goes straight and turns sharply. If that leaves more than noise, or bends all along, a hand has moved the
    needle: sharp turns follow a tremor in noise as large, and seem more certain than they are.
    """
    ones = np.ones(len(depth))
    quiet, variances = _straight(depth, ones)
    if effective_samples(depth - quiet) < WHITE * len(depth) or _bends(quiet):
        variances = _of_hand(depth)
        quiet = _solved(variances, ones, depth)
    return quiet, variances


def _bends(quiet: Array) -> bool:
    """Whether a motion (n,) bends in more samples than those of turns."""
    bends = np.sort(np.abs(np.diff(quiet, 2)))[::-1]
    most = int(np.searchsorted(np.cumsum(bends), MOSTLY * bends.sum()))
    return most > max(TURNS, BENT * len(bends))


def _straight(depth: Array, weights: Array) -> tuple[Array, Array]:
    """The same for the motion of a machine. weights (n,): what each sample tells."""
    variances = _of_machine(depth, weights)
    return _solved(variances, weights, weights * depth), variances


def _of_machine(depth: Array, weights: Array) -> Array:
    """Variances (n - 2,) of the second differences where few are not 0.

    They have Student's t distribution with one degree of freedom, by reweighting (Lange, Little and Taylor 1989).
    """
    variances = np.full(len(depth) - 2, 0.25)
    for _ in range(ROUNDS):
        second = np.diff(_solved(variances, weights, weights * depth), 2)
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
        second = np.diff(_solved(variances, np.ones(len(depth)), depth), 2)
        share = np.interp(np.log(variances), np.log(grid), shares)
        variances = np.clip(np.convolve(second**2, near, "same") / np.convolve(share, near, "same"), LEAST, MOST)
    return variances


def _solved(variances: Array, weights: Array, columns: Array) -> Array:
    """(diag(weights) + D^T diag(variances)^-1 D)^-1 columns, D: second differences."""
    from scipy.linalg import solveh_banded

    shape = (1.0, -2.0, 1.0)
    upper = np.zeros((3, len(columns)))
    upper[2] = weights
    for i in range(3):
        for j in range(i, 3):
            upper[2 + i - j, j : j + len(variances)] += shape[i] * shape[j] / variances
    return np.asarray(solveh_banded(upper, columns))


def _draws(variances: Array, weights: Array) -> Array:
    """Draws (m, n) of what is wrong with the most likely depth, in units of the noise: the same in every run."""
    samples = len(variances) + 2
    rng = np.random.default_rng(0)
    count = int(np.clip(NUMBERS // samples, FEWEST_DRAWS, DRAWS))
    pushes = rng.normal(size=(samples, count)) * np.sqrt(weights)[:, None]
    bent = rng.normal(size=(samples - 2, count)) / np.sqrt(variances)[:, None]
    pushes[:-2] += bent
    pushes[1:-1] -= 2 * bent
    pushes[2:] += bent
    return _solved(variances, weights, pushes).T


def _follows(trace: Trace, left: Array) -> bool:
    """Whether the force follows what the quiet depth leaves (n,)."""
    left, force = np.diff(left, 2), np.diff(trace.force, 2)
    size = float(np.sqrt((left @ left) * (force @ force)))
    return size > 0 and float(left @ force) / size > SURE / np.sqrt(len(left))
