"""K06 (33), and one exact tick of (21)-(23) in one dimension, over lanes of cases."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from oracles import first_root
from oracles.law import Law, band, steepest


@dataclass(frozen=True)
class Coupling:
    """Lanes of virtual couplings: K [N/m], B [N s/m], T [s]."""

    K: np.ndarray
    B: np.ndarray
    T: np.ndarray

    @property
    def D(self):
        return self.K * self.T + self.B

    @property
    def g(self):
        return self.D / self.T

    def astype(self, dtype) -> "Coupling":
        return Coupling(self.K.astype(dtype), self.B.astype(dtype), self.T.astype(dtype))

    def lanes(self, which) -> "Coupling":
        return Coupling(self.K[which], self.B[which], self.T[which])


@dataclass(frozen=True)
class State:
    """What one tick leaves to the next: f(k), e(k), p(k)."""

    f: np.ndarray
    e: np.ndarray
    p: np.ndarray


Tick = Callable[[Law, Coupling, State, np.ndarray], np.ndarray]


def f_star(c: Coupling, s: State, p):
    """The force that would hold the proxy still. K06 (27)."""
    return -c.g * (p - s.p) + c.K * s.e


def paper(L: Law, c: Coupling, s: State, p):
    """f(k) of K06 (33)."""
    q_star = p + (c.B * s.e + c.T * s.f) / c.D
    hold = f_star(c, s, p)
    lower, upper = band(L, q_star)
    return np.where(hold < lower, lower, np.where(hold > upper, upper, hold))


def contracts(L: Law, c: Coupling):
    """Whether (33) forgets a rounding error: its gain |dPhi/dq| / g is below (1 + a) / (1 + 2 a), a = B/D.

    See test_no_chatter.py for the recursion that this comes from.
    """
    a = c.B / c.D
    return steepest(L) / c.g < (1 + a) / (1 + 2 * a)


def paper_alternatives(L: Law, c: Coupling, s: State, p):
    """(3, lanes): what (33) gives for q* and for a rounding to either side: they differ at the jumps of a thin law."""
    q_star = p + (c.B * s.e + c.T * s.f) / c.D
    slack = 4 * np.spacing(np.maximum(abs(p), abs(p - q_star)))
    return np.stack([np.clip(f_star(c, s, p), *band(L, q_star + side * slack)) for side in (0, -1, 1)])


def exact(L: Law, c: Coupling, s: State, p):
    """f(k) of (21)-(23): stuck, or at the first root in the direction of motion (docs/errata.md)."""
    hold = f_star(c, s, p)
    q_prev = s.p + s.e
    lower, upper = band(L, q_prev)
    q0 = p + c.B * s.e / c.D
    q = first_root.slide(L, c.g, q0, q_prev, inwards=hold < lower)
    return np.where((hold >= lower) & (hold <= upper), hold, c.g * (q - q0))


def offset(c: Coupling, s: State, f):
    """e(k) of K06 (25)."""
    return (c.B * s.e + c.T * f) / c.D


def start(p) -> State:
    """Before the first tick: no force, no offset, p(k-1) = p(0)."""
    return State(np.zeros_like(p), np.zeros_like(p), p)


def run(tick: Tick, L: Law, c: Coupling, p):
    """(f, e), each (ticks, lanes), of a run from rest over the positions p (ticks, lanes)."""
    f, e, s = np.empty_like(p), np.empty_like(p), start(p[0])
    for k, now in enumerate(p):
        f[k] = tick(L, c, s, now)
        e[k] = offset(c, s, f[k])
        s = State(f[k], e[k], now)
    return f, e
