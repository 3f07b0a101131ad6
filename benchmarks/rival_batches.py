"""K06 (33) for many trials at once, transcribed for NumPy, Numba and JAX and written for speed.

The constants of the thick law are divided out beforehand, as in fused_1d.hpp. Each function takes depths (ticks,
trials), m, and Constants of the trials, and returns the forces (ticks, trials), N.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Constants(NamedTuple):
    """Of the thick law (15) to (19) and the coupling (21), each (trials,)."""

    x: Array
    h: Array
    two_q: Array
    half_a_i: Array  # A_I / 2H
    half_a_o: Array  # A_O / 2H
    f: Array  # F / H
    k: Array
    g: Array  # K + B/T
    inv_g: Array
    b_over_d: Array  # B / (K T + B)


def numpy_batch(p: Array, c: Constants) -> Array:
    """One NumPy operation for all trials."""
    force = np.empty_like(p)
    p_prev, e, f = p[0], np.zeros(p.shape[1]), np.zeros(p.shape[1])
    for k, now in enumerate(p):
        rest = c.b_over_d * e
        f_star = c.k * e - c.g * (now - p_prev)
        q = now + rest + c.inv_g * f
        far = q - c.h
        near_tip, far_tip = np.minimum(q, c.x), np.minimum(far, c.x)
        z, z_far = np.maximum(near_tip, 0.0), np.maximum(far_tip, 0.0)
        tip = z * (z + c.two_q) - z_far * (z_far + c.two_q)
        shaft = c.f * ((q - near_tip) - (far - far_tip))
        f = np.minimum(np.maximum(f_star, -(c.half_a_i * tip + shaft)), c.half_a_o * tip + shaft)
        e = rest + c.inv_g * f
        p_prev = now
        force[k] = f
    return force


def numba_batch(lanes: int) -> Callable[[Array, Constants], Array]:
    """Blocks of `lanes` trials, whose inner loop LLVM turns into vectors."""
    import numba

    @numba.njit(error_model="numpy")  # type: ignore[untyped-decorator]
    def blocks(
        p: Any, force: Any, x: Any, h: Any, two_q: Any, a_i: Any, a_o: Any, fr: Any, k: Any, g: Any, inv_g: Any, bd: Any
    ) -> None:
        ticks, trials = p.shape
        for start in range(0, trials, lanes):
            e, f, p_prev = np.zeros(lanes), np.zeros(lanes), p[0, start : start + lanes].copy()
            for t in range(ticks):
                row, out = p[t, start : start + lanes], force[t, start : start + lanes]
                for i in range(len(row)):
                    j = start + i
                    rest = bd[j] * e[i]
                    f_star = k[j] * e[i] - g[j] * (row[i] - p_prev[i])
                    q = row[i] + rest + inv_g[j] * f[i]
                    far = q - h[j]
                    near_tip, far_tip = min(q, x[j]), min(far, x[j])
                    z, z_far = max(near_tip, 0.0), max(far_tip, 0.0)
                    tip = z * (z + two_q[j]) - z_far * (z_far + two_q[j])
                    shaft = fr[j] * ((q - near_tip) - (far - far_tip))
                    f[i] = min(max(f_star, -(a_i[j] * tip + shaft)), a_o[j] * tip + shaft)
                    e[i] = rest + inv_g[j] * f[i]
                    p_prev[i] = row[i]
                    out[i] = f[i]

    def run(p: Array, c: Constants) -> Array:
        force = np.empty_like(p)
        blocks(p, force, *c)
        return force

    return run


def jax_batch() -> Callable[[Array, Constants], Array]:
    """A scan over the ticks, compiled by XLA."""
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)

    @jax.jit
    def scan(p: Any, c: Constants) -> Any:
        def tick(state: Any, now: Any) -> Any:
            p_prev, e, f = state
            rest = c.b_over_d * e
            f_star = c.k * e - c.g * (now - p_prev)
            q = now + rest + c.inv_g * f
            far = q - c.h
            near_tip, far_tip = jnp.minimum(q, c.x), jnp.minimum(far, c.x)
            z, z_far = jnp.maximum(near_tip, 0.0), jnp.maximum(far_tip, 0.0)
            tip = z * (z + c.two_q) - z_far * (z_far + c.two_q)
            shaft = c.f * ((q - near_tip) - (far - far_tip))
            f = jnp.minimum(jnp.maximum(f_star, -(c.half_a_i * tip + shaft)), c.half_a_o * tip + shaft)
            return (now, rest + c.inv_g * f, f), f

        zero = jnp.zeros(p.shape[1])
        return jax.lax.scan(tick, (p[0], zero, zero), p)[1]

    return lambda p, c: np.asarray(scan(p, c))


def constants(laws: list[Any], stiffness: float, damping: float, period: float) -> Constants:
    """Of ThickLaws with H > 0 at no obliquity, and one coupling."""

    def each(of: Callable[[Any], float]) -> Array:
        return np.array([of(law) for law in laws])

    n, d = len(laws), stiffness * period + damping
    fixed = [np.full(n, v) for v in (stiffness, stiffness + damping / period, period / d, damping / d)]
    return Constants(
        each(lambda law: law.X),
        each(lambda law: law.H),
        each(lambda law: 2 * law.Q),
        each(lambda law: law.A_I / (2 * law.H)),
        each(lambda law: law.A_O / (2 * law.H)),
        each(lambda law: law.F / law.H),
        *fixed,
    )


def motion(ticks: int, trials: int, period: float) -> Array:
    """Strokes through the membrane and back, each with its own phase and tremor, (ticks, trials), m."""
    random = np.random.default_rng(7)
    time = np.arange(ticks)[:, None] * period
    phase, hertz, stroke = random.random(trials), random.uniform(8, 12, trials), random.uniform(0.6, 1, trials)
    depth = 9e-3 * np.sin(math.pi * (time / stroke + phase)) ** 2
    return np.ascontiguousarray(-2e-3 + depth + 5e-5 * np.sin(2 * math.pi * hertz * time + 6 * phase))
