"""K06 (41) with the answers of docs/errata.md (E1, E2, E3, E6), over lanes; and its exact counterpart.

One lane is one membrane. Vectors are (lanes, 3), depths and scalars (lanes,).
"""

from dataclasses import dataclass, replace

import numpy as np

from oracles import first_root
from oracles.law import Law, band
from oracles.proxy_1d import Coupling

LARGEST_OBLIQUITY = np.deg2rad(80)


@dataclass(frozen=True)
class Plane:
    """The membrane's surface: a point on it [m] and its inward unit normal."""

    a: np.ndarray
    n: np.ndarray


@dataclass(frozen=True)
class State:
    """What one tick leaves to the next. `inside`: entered; `barred`: inside, but not by the front (E6)."""

    f: np.ndarray
    e: np.ndarray
    p: np.ndarray
    inside: np.ndarray
    barred: np.ndarray
    b: np.ndarray

    def lanes(self, which) -> "State":
        return State(*(getattr(self, k)[which] for k in ("f", "e", "p", "inside", "barred", "b")))


def dot(u, v):
    return (u * v).sum(-1)


def v3(scalar):
    return scalar[:, None]


def start(plane: Plane, p) -> State:
    """Before the first tick. A tip that starts inside is barred until it has been outside, in front (E6)."""
    none = np.zeros(len(p), dtype=bool)
    return State(0 * p, 0 * p, p, none, dot(plane.n, p - plane.a) > 0, 0 * p)


def f_star(c: Coupling, s: State, p):
    """K06 (38)."""
    return -v3(c.g) * (p - s.p) + v3(c.K) * s.e


def arrive(plane: Plane, s: State, in_front, axis):
    """(inside, barred, b) after the judgement of entry: only from outside, and within 80 degrees of the normal."""
    enters = ~in_front & ~s.inside & ~s.barred
    allowed = dot(plane.n, axis) >= np.cos(LARGEST_OBLIQUITY)
    b = np.where(v3(enters & allowed), axis, s.b)
    return ~in_front & (s.inside | (enters & allowed)), ~in_front & (s.barred | (enters & ~allowed)), b


def paper(plane: Plane, L: Law, c: Coupling, s: State, p, axis) -> State:
    """One tick of K06 (41); L.U is ignored, because entry sets it."""
    q_star = p + (v3(c.B) * s.e + v3(c.T) * s.f) / v3(c.D)
    height = dot(plane.n, q_star - plane.a)
    inside, barred, b = arrive(plane, s, height <= 0, axis)
    cos_beta = np.where(inside, dot(plane.n, b), 1)
    hold = f_star(c, s, p)
    hold_b = dot(b, hold)
    lower, upper = band(L.with_cos_beta(cos_beta), height / cos_beta)
    along = np.where(hold_b < lower, lower, np.where(hold_b > upper, upper, hold_b))
    f = np.where(v3(inside), hold + b * v3(along - hold_b), 0)
    return State(f, (v3(c.B) * s.e + v3(c.T) * f) / v3(c.D), p, inside, barred, b)


def exact(plane: Plane, L: Law, c: Coupling, s: State, p, axis) -> State:
    """One tick of (35)-(38) with (23) along b, solved at its first root."""
    free = p + v3(c.B) * s.e / v3(c.D)
    entered, barred, b = arrive(plane, s, dot(plane.n, free - plane.a) <= 0, axis)
    inside = s.inside | entered  # once inside, only the solution itself leaves
    cos_beta = np.where(inside, dot(plane.n, b), 1)
    law = L.with_cos_beta(cos_beta)
    hold = f_star(c, s, p)
    hold_b = dot(b, hold)
    before = dot(plane.n, s.p + s.e - plane.a) / cos_beta
    lower, upper = band(law, before)
    stuck = (hold_b >= lower) & (hold_b <= upper)
    depth, along = before.copy(), hold_b.copy()
    m = np.flatnonzero(inside & ~stuck)
    if len(m):
        q0 = before[m] - hold_b[m] / c.g[m]
        depth[m] = first_root.slide(law.lanes(m), c.g[m], q0, before[m], inwards=hold_b[m] < lower[m])
        along[m] = c.g[m] * (depth[m] - q0)
    # A needle held on the very surface of an infinitely thin membrane (a jump of phi, which bisection meets from
    # either side) has not left.
    inside &= (depth > 0) | ((L.H == 0) & (abs(depth) <= np.finfo(float).tiny) & (along != 0))
    f = np.where(v3(inside), hold + b * v3(along - hold_b), 0)
    return State(f, (v3(c.B) * s.e + v3(c.T) * f) / v3(c.D), p, inside, barred, b)


def run(tick, plane: Plane, L: Law, c: Coupling, p, axis) -> list[State]:
    """The states after each tick, from rest; p and axis are (ticks, lanes, 3)."""
    s, states = start(plane, p[0]), []
    for now, direction in zip(p, axis, strict=True):
        s = tick(plane, L, c, s, now, direction)
        states.append(s)
    return states


def observed(s: State, f, e) -> State:
    """The same bookkeeping with the force and offset that another implementation found."""
    return replace(s, f=f, e=e)
