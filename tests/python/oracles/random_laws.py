"""Random admissible needles and membranes, from ordinary to extreme, with realistic forces (0.01 to 20 N)."""

from dataclasses import dataclass

import numpy as np

from oracles.law import Law, law

WIDEST = np.deg2rad(75)
"""The largest obliquity drawn [rad]: venipuncture's."""


@dataclass(frozen=True)
class Parameters:
    """Lanes of needle and membrane parameters, SI."""

    diameter: np.ndarray
    tip_angle: np.ndarray
    stiffness: np.ndarray
    precompression: np.ndarray
    friction: np.ndarray
    thickness: np.ndarray
    obliquity: np.ndarray

    def law(self, dtype=np.float64) -> Law:
        return law(
            self.diameter, self.tip_angle, self.stiffness, self.precompression, self.friction,
            self.thickness, self.obliquity, dtype=dtype,
        )  # fmt: skip


def log_uniform(rng, low, high, size):
    return np.exp(rng.uniform(np.log(low), np.log(high), size))


def needles(rng, n):
    """(diameter, tip_angle): a third of the tips are steep, up to 0.02 rad from a flat end."""
    steep = np.pi / 2 - log_uniform(rng, 0.02, 0.6, n)
    angle = np.where(rng.random(n) < 0.33, steep, rng.uniform(0.05, 1.0, n))
    return log_uniform(rng, 0.2e-3, 3e-3, n), angle


def membranes(rng, diameter, tip_angle, thinnest=1e-5, thickest=2e-2):
    """(stiffness, precompression, friction, thickness) so that K06 (7) holds and the peak force is 0.01 to 20 N.

    Friction comes as near to the bound of (7) as mu tan(theta) = 0.995; A_O takes both signs.
    """
    n, t = len(diameter), np.tan(tip_angle)
    near = (1 - log_uniform(rng, 5e-3, 0.9, n)) / t
    friction = np.minimum(np.where(rng.random(n) < 0.3, near, log_uniform(rng, 0.005, 1.5, n)), near)
    share = np.where(rng.random(n) < 0.2, 0, rng.uniform(0, 0.95, n))  # share of precompression in the grip
    peak = log_uniform(rng, 0.01, 20, n)
    grip = peak * (1 - friction * t) / (2 * friction + (1 - friction**2) * t)  # kappa w + c; A_I (X + Q) = peak
    thickness = log_uniform(rng, thinnest, thickest, n)
    return grip * (1 - share) / diameter, grip * share, friction, thickness


def parameters(seed, n, thinnest=1e-5, widest=WIDEST) -> Parameters:
    """n random laws; the same seed gives the same laws."""
    rng = np.random.default_rng([seed, n])
    diameter, tip_angle = needles(rng, n)
    stiffness, precompression, friction, thickness = membranes(rng, diameter, tip_angle, thinnest)
    obliquity = np.where(rng.random(n) < 0.2, 0, rng.uniform(0, widest, n))
    return Parameters(diameter, tip_angle, stiffness, precompression, friction, thickness, obliquity)


def depths(seed, L: Law, n) -> np.ndarray:
    """(lanes, n) depths that meet every piece of every law, its breaks, the shaft far behind it, and the outside."""
    rng = np.random.default_rng([seed, n, 1])
    lanes = len(L.X)
    corners = np.stack([0 * L.X, np.minimum(L.U, L.X), np.maximum(L.U, L.X), L.X + L.U], axis=-1)
    ends = np.concatenate([-0.2 * corners[:, 3:], corners, 1.2 * corners[:, 3:] + 0.05], axis=1)
    piece = rng.integers(0, 5, (lanes, n - 4))
    low, high = np.take_along_axis(ends, piece, 1), np.take_along_axis(ends, piece + 1, 1)
    return np.concatenate([corners, low + (high - low) * rng.random((lanes, n - 4))], axis=1).astype(np.float64)
