"""Random 3-D scenes: 1 to 4 tilted membranes, a needle that moves through them, and the cases of E6."""

from dataclasses import dataclass, fields, replace

import numpy as np

from oracles import motions, random_laws
from oracles.law import Law
from oracles.proxy_1d import Coupling
from oracles.proxy_3d import Plane


@dataclass(frozen=True)
class Scenes:
    """Lanes are membranes, in scene order; `scene` is the scene of each. Motions are per scene, couplings per lane."""

    parameters: random_laws.Parameters
    law: Law  # normal insertion; entry sets the obliquity
    plane: Plane
    scene: np.ndarray
    coupling: Coupling
    p: np.ndarray  # (ticks, scenes, 3) [m]
    axis: np.ndarray  # (ticks, scenes, 3), unit
    low_pass: np.ndarray  # (scenes,) [Hz], 0 is off

    def members(self, scene) -> np.ndarray:
        """The lanes of one scene."""
        return np.flatnonzero(self.scene == scene)


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def across(rng, v):
    """Random unit vectors perpendicular to v."""
    return unit(np.cross(v, unit(rng.standard_normal(v.shape))))


def scenes(seed, n, ticks) -> Scenes:
    """n random scenes: 1 in 10 starts inside, 1 in 10 grazes beyond 80 degrees, 1 in 20 comes from behind."""
    rng = np.random.default_rng([seed, n, 5])
    members = rng.integers(1, 5, n)
    scene = np.repeat(np.arange(n), members)
    lanes = len(scene)
    order = np.arange(lanes) - np.repeat(np.cumsum(members) - members, members)

    diameter, tip_angle = (v[scene] for v in random_laws.needles(rng, n))
    stiffness, precompression, friction, thickness = random_laws.membranes(rng, diameter, tip_angle)
    thickness = np.select([rng.random(lanes) < 0.05, rng.random(lanes) < 0.1], [0, 1e-5], thickness)
    draw = rng.random(n)
    obliquity = np.select([draw < 0.1, draw < 0.15], [rng.uniform(80.5, 100, n), rng.uniform(150, 180, n)],
                          rng.uniform(0, 65, n))  # fmt: skip
    parameters = random_laws.Parameters(
        diameter, tip_angle, stiffness, precompression, friction, thickness, np.zeros(lanes)
    )
    L = parameters.law()

    forward = unit(rng.standard_normal((n, 3)))
    beta = np.deg2rad(obliquity)[:, None]
    normal = (np.cos(beta) * forward + np.sin(beta) * across(rng, forward))[scene]
    tilt = np.deg2rad(rng.uniform(0, 10, lanes) * (order > 0))[:, None]
    normal = unit(np.cos(tilt) * normal + np.sin(tilt) * across(rng, normal))
    length = np.clip((L.X + L.U), 2e-4, 0.02)
    place = np.zeros(lanes)
    for i in range(1, lanes):
        place[i] = 0 if order[i] == 0 else place[i - 1] + rng.uniform(0, 1) * length[i - 1]
    origin = rng.uniform(-0.05, 0.05, (n, 3))
    a = origin[scene] + place[:, None] * forward[scene] + rng.uniform(0, 5e-3, (lanes, 1)) * across(rng, normal)

    K, B, T = motions.couplings(seed, n)
    reach = np.zeros(n)
    np.maximum.at(reach, scene, place + length)
    depth = motions.depths(seed, reach, T, ticks) + np.where(rng.random(n) < 0.1, 0.6 * reach, 0)
    phase = np.arange(ticks)[:, None, None] * rng.uniform(0, 0.1, (1, n, 1))
    sway = across(rng, forward) * (rng.uniform(0, 0.05, n) * reach)[:, None] * np.sin(phase)
    p = origin + depth[:, :, None] * forward + sway
    wobble = across(rng, forward) * (rng.random((n, 1)) < 0.5) * np.deg2rad(5) * np.cos(phase)
    axis = unit(np.broadcast_to(forward, p.shape) + wobble)
    low_pass = np.where(rng.random(n) < 0.3, 0, random_laws.log_uniform(rng, 0.02, 0.4, n) / T)
    coupling = Coupling(K[scene], B[scene], T[scene])
    return Scenes(parameters, L, Plane(a, normal), scene, coupling, p, axis, low_pass)


def lane_motions(s: Scenes):
    """(p, axis) for every lane: (ticks, lanes, 3)."""
    return s.p[:, s.scene], s.axis[:, s.scene]


def longer(s: Scenes) -> Scenes:
    """The same scenes in extended precision."""
    c = s.coupling
    return replace(
        s, law=s.parameters.law(np.longdouble), plane=Plane(*(v.astype(np.longdouble) for v in (s.plane.a, s.plane.n))),
        coupling=Coupling(*(getattr(c, f.name).astype(np.longdouble) for f in fields(c))),
        p=s.p.astype(np.longdouble), axis=s.axis.astype(np.longdouble),
    )  # fmt: skip
