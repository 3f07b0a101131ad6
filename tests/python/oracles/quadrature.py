"""K06 (16) by quadrature, in extended precision.

The path [q - U, q] is split where phi jumps or bends (0 and X); on each smooth part a two-point Gauss-Legendre rule is
exact, because phi is linear there. What is left is rounding: eps (longdouble) * X / H, 1e-15 for H = 1 micrometre.
"""

import itertools

import numpy as np

from oracles.law import Law

NODE = np.sqrt(np.longdouble(3)) / 3


def _phi(xi, A, L: Law, sign):
    """K06 (13), (14), inside their smooth parts."""
    return sign * np.where(xi < 0, 0, np.where(xi <= L.X, A * (xi + L.Q), L.F))


def _average(q, A, L: Law, sign):
    q = np.asarray(q, dtype=np.longdouble)
    first = q - L.U
    cuts = [first, np.clip(0 * q, first, q), np.clip(L.X + 0 * q, first, q), q]
    total = np.zeros_like(q)
    for low, high in itertools.pairwise(cuts):
        middle, half = (low + high) / 2, (high - low) / 2
        total += half * (_phi(middle - NODE * half, A, L, sign) + _phi(middle + NODE * half, A, L, sign))
    return total / L.H


def band(L: Law, q):
    """(Phi_I, Phi_O) [N] of laws given in longdouble with H > 0."""
    return _average(q, L.A_I, L, -1), _average(q, L.A_O, L, +1)
