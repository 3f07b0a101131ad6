"""The exact solution of K06 (21)-(23) for many trials at once, transcribed for Numba and JAX and written for speed.

The algorithm is that of core/punctura/proxy/exact_friction.hpp. Depths, forces and Constants are those of
rival_batches.py.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from rival_batches import Array, Constants

PIECES = 5


class Tables(NamedTuple):
    """The bands of the trials: K06 (18) and (19) as pieces c0 + c1 x + c2 x^2, x behind the origin of the piece."""

    ends: NDArray[np.float64]  # (trials, 5): where each piece ends, m
    origins: NDArray[np.float64]  # (trials, 5), m
    lower: NDArray[np.float64]  # (trials, 5, 3): Phi_I, N
    upper: NDArray[np.float64]  # (trials, 5, 3): Phi_O, N


def tables(c: Constants) -> Tables:
    """The cases 1 to 6 of (18) and (19) for needles at right angles to the membranes, U = H."""
    x, h, q, f = c.x, c.h, c.two_q / 2, c.f
    short, long = np.minimum(h, x), np.maximum(h, x)
    breaks = np.stack([np.zeros_like(x), short, long, x + h], axis=1)

    def edge(half_a: Array, sign: float) -> NDArray[np.float64]:
        a, pieces = 2 * half_a, np.zeros((len(x), PIECES, 3))
        pieces[:, 1, 1], pieces[:, 1, 2] = a * q, half_a
        pieces[:, 2, 0] = a * short * (short / 2 + q)
        pieces[:, 2, 1] = np.where(h <= x, a * h, f)
        pieces[:, 3, 0] = a * short * (x + q - short / 2) + f * np.maximum(h - x, 0)
        pieces[:, 3, 1], pieces[:, 3, 2] = a * (short - x - q) + f, -half_a
        pieces[:, 4, 0] = f * h
        return sign * pieces

    ends = np.concatenate([breaks, np.full((len(x), 1), np.inf)], axis=1)
    origins = np.concatenate([np.zeros((len(x), 1)), breaks], axis=1)
    return Tables(ends, origins, edge(c.half_a_i, -1.0), edge(c.half_a_o, 1.0))


def numba_exact(lanes: int) -> Callable[[Array, Constants], Array]:
    """Blocks of `lanes` trials. A trial looks only at the pieces through which it slides."""
    import numba

    compiled = numba.njit(error_model="numpy")  # type: ignore[untyped-decorator]

    @compiled
    def slide(ends: Any, origins: Any, edges: Any, i: int, sign: float, q: float, f_star: float, g: float) -> float:
        start = q
        while True:
            c0, c1, c2 = edges[i, 0], edges[i, 1], edges[i, 2]
            y = start - origins[i]
            coupling = f_star + g * (start - q)
            gap = sign * (c0 + y * (c1 + y * c2) - coupling)
            if gap <= 0:
                return coupling
            if i == (PIECES - 1 if sign > 0 else 0):
                return c0
            a, b = sign * c2, c1 + 2 * c2 * y - g
            if a == 0:
                x = -gap / b
            else:
                root = np.sqrt(b * b - 4 * a * gap)
                x = 2 * gap / (root - b) if b <= 0 else -(root + b) / (2 * a)
            end = ends[i] if sign > 0 else ends[i - 1]
            if x >= 0 and x <= sign * (end - start):
                y += sign * x
                return c0 + y * (c1 + y * c2)
            start = end
            i += 1 if sign > 0 else -1

    @compiled
    def blocks(p: Any, force: Any, ends: Any, origins: Any, lower: Any, upper: Any, k: Any, g: Any, inv_g: Any) -> None:
        ticks, trials = p.shape
        for first in range(0, trials, lanes):
            last = min(first + lanes, trials)
            e, p_prev = np.zeros(last - first), p[0, first:last].copy()
            piece = np.zeros(last - first, np.int64)  # of the last tick: most trials stay in it
            for t in range(ticks):
                for j in range(first, last):
                    now, before, old = p[t, j], p_prev[j - first], e[j - first]
                    q = before + old
                    f_star = k[j] * old - g[j] * (now - before)
                    i = piece[j - first]
                    while i > 0 and (q < ends[j, 0] if i == 1 else q <= ends[j, i - 1]):
                        i -= 1
                    while i < PIECES - 1 and (q >= ends[j, 0] if i == 0 else q > ends[j, i]):
                        i += 1
                    piece[j - first] = i
                    y, low, up = q - origins[j, i], lower[j, i], upper[j, i]
                    f = f_star
                    if f_star < low[0] + y * (low[1] + y * low[2]):
                        f = slide(ends[j], origins[j], lower[j], i, 1.0, q, f_star, g[j])
                    elif f_star > up[0] + y * (up[1] + y * up[2]):
                        f = slide(ends[j], origins[j], upper[j], i, -1.0, q, f_star, g[j])
                    e[j - first] = old - (now - before) + inv_g[j] * (f - f_star)
                    p_prev[j - first] = now
                    force[t, j] = f

    def run(p: Array, c: Constants) -> Array:
        force = np.empty_like(p)
        blocks(p, force, *tables(c), c.k, c.g, c.inv_g)
        return force

    return run


def jax_exact() -> Callable[[Array, Constants], Array]:
    """A scan over the ticks, compiled by XLA. Each trial visits the pieces in its direction until all have stopped.

    Each visit is a branch of its own (lax.cond). Otherwise XLA computes each piece again for each use of its results.
    """
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)

    def value(edge: Any, y: Any) -> Any:
        return edge[0] + y * (edge[1] + y * edge[2])

    @jax.jit
    def scan(p: Any, t: Any, c: Constants) -> Any:
        ends, origins = t.ends.T, t.origins.T
        begins = jnp.concatenate([jnp.full((1, p.shape[1]), -jnp.inf), ends[:-1]])
        lower, upper = jnp.moveaxis(t.lower, 0, -1), jnp.moveaxis(t.upper, 0, -1)

        def reached(i: int, q: Any) -> Any:
            """Whether q is behind the start of piece i."""
            return q >= begins[i] if i <= 1 else q > begins[i]

        def visit(trip: int, seen: Any) -> Any:
            slides_in, q, f_star, force, found, start = seen
            back, sign = PIECES - 1 - trip, jnp.where(slides_in, 1.0, -1.0)
            edge = jnp.where(slides_in, lower[trip], upper[back])
            y = start - jnp.where(slides_in, origins[trip], origins[back])
            coupling = f_star + c.g * (start - q)
            gap = sign * (value(edge, y) - coupling)
            if trip == PIECES - 1:
                return (
                    slides_in,
                    q,
                    f_star,
                    jnp.where(found, force, jnp.where(gap <= 0, coupling, edge[0])),
                    found,
                    start,
                )
            sliding = jnp.where(slides_in, ~reached(trip + 1, q), reached(back, q))
            a, b = sign * edge[2], edge[1] + 2 * edge[2] * y - c.g
            root, falls = jnp.sqrt(b * b - 4 * a * gap), b <= 0
            top, bottom = jnp.where(falls, 2 * gap, -(root + b)), jnp.where(falls, root - b, 2 * a)
            x = jnp.where(a == 0, -gap, top) / jnp.where(a == 0, b, bottom)
            end = jnp.where(slides_in, ends[trip], begins[back])
            met, within = gap <= 0, (x >= 0) & (x <= sign * (end - start))
            stops = sliding & ~found & (met | within)
            force = jnp.where(stops, jnp.where(met, coupling, value(edge, y + sign * x)), force)
            return slides_in, q, f_star, force, found | stops, jnp.where(sliding, end, start)

        def tick(state: Any, now: Any) -> Any:
            before, e = state
            q, f_star = before + e, c.k * e - c.g * (now - before)
            low, up = value(lower[0], q), value(upper[0], q)
            for i in range(1, PIECES):
                y, here = q - origins[i], reached(i, q)
                low, up = jnp.where(here, value(lower[i], y), low), jnp.where(here, value(upper[i], y), up)
            slides_in = f_star < low
            seen = slides_in, q, f_star, f_star, ~(slides_in | (f_star > up)), q
            for trip in range(PIECES):
                seen = jax.lax.cond(jnp.all(seen[4]), lambda same: same, partial(visit, trip), seen)
            force = seen[3]
            return (now, e - (now - before) + c.inv_g * (force - f_star)), force

        return jax.lax.scan(tick, (p[0], jnp.zeros(p.shape[1])), p)[1]

    return lambda p, c: np.asarray(scan(p, tables(c), c))
