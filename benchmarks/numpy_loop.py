"""A straightforward K06 (33): a law on NumPy arrays and a loop over the ticks. Written for clarity, not optimised."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# K06 section 4, the membrane of 1.0 mm: the first membrane in work.hpp.
W, THETA, KAPPA, C, MU, H = 1.08e-3, 0.28, 570.0, 0.41, 0.2, 1.0e-3
K, B, T = 400.0, 1.0, 1 / 1600
G = (K * T + B) / T
D = K * T + B

# K06 (15)
TAN = np.tan(THETA)
X = W / TAN
A_I = KAPPA * TAN * (2 * MU + (1 - MU**2) * TAN) / (1 - MU * TAN)
A_O = KAPPA * TAN * (2 * MU - (1 - MU**2) * TAN) / (1 + MU * TAN)
Q = C / (KAPPA * TAN)
F = 2 * MU * (KAPPA * W + C)


def primitive(q: Array, a: float) -> Array:
    """Integral of the thin law's magnitude from 0 to q, N m."""
    z = np.clip(q, 0, X)
    integral: Array = a * z * (z + 2 * Q) / 2 + F * np.maximum(q - X, 0)
    return integral


def bounds(q: Array) -> tuple[Array, Array]:
    """Phi_I and Phi_O at depth q, N. K06 (18), (19)."""
    return -(primitive(q, A_I) - primitive(q - H, A_I)) / H, (primitive(q, A_O) - primitive(q - H, A_O)) / H


def numpy_loop(p: Array) -> Array:
    """Forces (N) for the depths p (m) by K06 (33), tick by tick, with NumPy."""
    force = np.zeros_like(p)
    p_prev, e, f = p[0], np.float64(0), np.float64(0)
    for k in range(len(p)):
        f_star = -G * (p[k] - p_prev) + K * e
        q_star = p[k] + (B * e + T * f) / D
        lower, upper = bounds(q_star)
        f = np.clip(f_star, lower, upper)
        e = (B * e + T * f) / D
        p_prev = p[k]
        force[k] = f
    return force


def python_loop(p: Array) -> Array:
    """The same with Python floats, without NumPy in the loop."""
    x, a_i, a_o, q_, f_shaft = float(X), float(A_I), float(A_O), float(Q), float(F)

    def g(q: float, a: float) -> float:
        z = min(max(q, 0.0), x)
        return a * z * (z + 2 * q_) / 2 + f_shaft * max(q - x, 0.0)

    force = []
    depths = p.tolist()
    p_prev, e, f = depths[0], 0.0, 0.0
    for now in depths:
        f_star = -G * (now - p_prev) + K * e
        q_star = now + (B * e + T * f) / D
        lower = -(g(q_star, a_i) - g(q_star - H, a_i)) / H
        upper = (g(q_star, a_o) - g(q_star - H, a_o)) / H
        f = min(max(f_star, lower), upper)
        e = (B * e + T * f) / D
        p_prev = now
        force.append(f)
    return np.array(force)


LOOPS: dict[str, Callable[[Array], Array]] = {"numpy": numpy_loop, "python": python_loop}
