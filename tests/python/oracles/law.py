"""K06 (13)-(15), (17) and the six printed cases of (18), (19), as in the paper with errata E3 and E4 corrected."""

from dataclasses import dataclass, fields, replace

import numpy as np


@dataclass(frozen=True)
class Law:
    """Lanes of laws. X, Q, H, U [m]; A_I, A_O [N/m]; F [N]; U/H.

    H = 0 is the infinitely thin membrane; entered at an angle, the limit of (16), (17) for H -> 0 is phi / cos(beta).
    """

    X: np.ndarray
    A_I: np.ndarray
    A_O: np.ndarray
    Q: np.ndarray
    F: np.ndarray
    H: np.ndarray
    U: np.ndarray
    U_by_H: np.ndarray

    def lanes(self, which) -> "Law":
        """The chosen lanes, or the same lanes with axes added: law.lanes(np.s_[:, None])."""
        return Law(**{f.name: getattr(self, f.name)[which] for f in fields(self)})

    def with_cos_beta(self, cos_beta) -> "Law":
        """The same membranes entered at another obliquity. K06 (17)."""
        return replace(self, U=self.H / cos_beta, U_by_H=1 / cos_beta + 0 * self.H)

    @property
    def largest(self) -> np.ndarray:
        """A bound on |Phi| [N]: the thin law's peak, stretched by the oblique path."""
        return self.U_by_H * np.maximum(self.A_I * (self.X + self.Q), self.F)


def law(w, theta, kappa, c, mu, H=0.0, beta=0.0, dtype=np.float64) -> Law:
    """K06 (15) and (17)."""
    w, theta, kappa, c, mu, H, beta = np.broadcast_arrays(
        *(np.atleast_1d(np.asarray(v, dtype=dtype)) for v in (w, theta, kappa, c, mu, H, beta))
    )
    t = np.tan(theta)
    return Law(
        X=w / t,
        A_I=kappa * t * (2 * mu + (1 - mu**2) * t) / (1 - mu * t),
        A_O=kappa * t * (2 * mu - (1 - mu**2) * t) / (1 + mu * t),
        Q=c / (kappa * t),
        F=2 * mu * (kappa * w + c),
        H=H.copy(),
        U=H / np.cos(beta),
        U_by_H=1 / np.cos(beta),
    )


def thin(L: Law, q):
    """K06 (13), (14): (phi_I, phi_O) [N]."""
    inside, shaft = (q >= 0) & (q <= L.X), q > L.X
    zero = np.zeros_like(q)
    return (
        np.select([inside, shaft], [-L.A_I * (q + L.Q), -L.F + zero], zero),
        np.select([inside, shaft], [L.A_O * (q + L.Q), L.F + zero], zero),
    )


def _printed(q, A, L: Law, sign):
    """One of (18), (19): A is A_I or A_O, sign is -1 or +1 (both have the same six cases)."""
    X, U, Q, F = L.X, L.U, L.Q, L.F
    H = np.where(L.H > 0, L.H, 1)  # H = 0 is answered by thin()
    cases = [
        (q < 0, 0 * q),
        (q <= np.minimum(U, X), A * q * (q + 2 * Q) / (2 * H)),
        (q <= X, A * U * (2 * q - U + 2 * Q) / (2 * H)),
        (q <= U, F * (q - X) / H + A * X * (X + 2 * Q) / (2 * H)),
        (q <= X + U, F * (q - X) / H + A * (U + X - q) * (q - U + X + 2 * Q) / (2 * H)),
    ]
    return sign * np.select([k for k, _ in cases], [v for _, v in cases], F * U / H + 0 * q)


def band(L: Law, q):
    """(lower, upper) edge of the friction band [N]: (18), (19), or (13), (14) where H = 0."""
    thin_lower, thin_upper = thin(L, q)
    lower, upper = _printed(q, L.A_I, L, -1), _printed(q, L.A_O, L, +1)
    return np.where(L.H > 0, lower, thin_lower * L.U_by_H), np.where(L.H > 0, upper, thin_upper * L.U_by_H)


def breaks(L: Law) -> np.ndarray:
    """The depths where the band changes its formula, along a new last axis, ascending [m]."""
    return np.stack([0 * L.X, np.minimum(L.U, L.X), np.maximum(L.U, L.X), L.X + L.U], axis=-1)


def steepest(L: Law) -> np.ndarray:
    """The largest |dPhi/dq| [N/m], from the derivative of (16): (phi(q) - phi(q - U)) / H; infinite where H = 0."""
    corners = breaks(L)
    places = np.concatenate([corners, (corners[:, 1:] + corners[:, :-1]) / 2], axis=1)
    places = np.concatenate([places * (1 - 1e-9), places * (1 + 1e-9)], axis=1)
    tall = L.lanes(np.s_[:, None])
    rise = np.subtract(thin(tall, places), thin(tall, places - tall.U))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(L.H > 0, abs(rise).max(axis=(0, 2)) / L.H, np.inf)
