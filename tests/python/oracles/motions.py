"""Random motions of a needle tip along a line: strokes, ramps, stops, hand noise, encoder steps, jumps."""

import numpy as np

from oracles.random_laws import log_uniform


def depths(seed, reach, T, ticks):
    """(ticks, lanes) tip depths [m] that start outside and work over [-0.3, 1.3] reach; T is the servo period [s]."""
    rng = np.random.default_rng([seed, ticks, 2])
    n, t = len(reach), np.arange(ticks)[:, None]
    start = -rng.uniform(0.02, 0.3, n) * reach

    strokes = rng.integers(1, 5, n) + 0.5
    sweep = 0.5 - 0.5 * np.cos(2 * np.pi * strokes * t / ticks)
    ramp = np.minimum(t / (ticks * rng.uniform(0.2, 0.9, n)), 1)
    kind = rng.integers(0, 3, n)
    path = np.select([kind == 0, kind == 1], [sweep, ramp], 0.6 * sweep + 0.4 * ramp)

    # Stops: the clock of some lanes halts for a while, twice.
    clock = np.ones((ticks, n))
    for _ in range(2):
        at, length = rng.integers(0, ticks, n), rng.integers(0, ticks // 4, n)
        clock[(t >= at) & (t < at + length) & (rng.random(n) < 0.5)] = 0
    now = np.cumsum(clock, axis=0).astype(int) - 1
    path = np.take_along_axis(path, np.maximum(now, 0), axis=0)

    p = start + path * (rng.uniform(0.3, 1.3, n) * reach - start)
    p += (rng.random(n) < 0.4) * log_uniform(rng, 1e-8, 5e-5, n) * rng.standard_normal((ticks, n))
    # Jumps: far faster than a hand.
    jumps = (rng.random((ticks, n)) < 0.01) & (rng.random(n) < 0.3)
    p += np.cumsum(jumps * rng.uniform(-1, 1, (ticks, n)), axis=0) * 0.5 * reach
    step = np.where(rng.random(n) < 0.3, log_uniform(rng, 1e-6, 5.5e-5, n), 0)  # an Omni's count is 0.055 mm
    return np.where(step > 0, np.round(p / np.where(step > 0, step, 1)) * step, p)


def couplings(seed, n):
    """(K, B, T): K over three decades, B/T from 0.01 K to 30 K or 0, 500 to 8000 Hz."""
    rng = np.random.default_rng([seed, n, 3])
    K, T = log_uniform(rng, 10, 1e4, n), 1 / log_uniform(rng, 500, 8000, n)
    B = np.where(rng.random(n) < 0.2, 0, K * T * log_uniform(rng, 0.01, 30, n))
    return K, B, T
