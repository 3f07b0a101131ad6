"""Random 1-D runs: a law, a coupling and a motion for every lane."""

from dataclasses import dataclass, replace

import numpy as np

from oracles import motions, random_laws
from oracles.law import Law
from oracles.proxy_1d import Coupling, State


@dataclass(frozen=True)
class Runs:
    parameters: random_laws.Parameters
    law: Law
    coupling: Coupling
    p: np.ndarray  # (ticks, lanes) [m]


def runs(seed, n, ticks) -> Runs:
    """n random runs, thin membranes (from 0.01 mm, and every twentieth of thickness 0) and steep laws among them."""
    parameters = random_laws.parameters(seed, n)
    rng = np.random.default_rng([seed, n, 4])
    thickness = np.where(rng.random(n) < 0.05, 0, parameters.thickness)
    thickness = np.where(rng.random(n) < 0.1, 1e-5, thickness)
    obliquity = np.where(thickness > 0, parameters.obliquity, 0)  # the thin law of section 2.1 is met at right angles
    parameters = replace(parameters, thickness=thickness, obliquity=obliquity)
    L = parameters.law()
    coupling = Coupling(*motions.couplings(seed, n))
    reach = np.clip(L.X + L.U, 2e-4, 0.04)
    return Runs(parameters, L, coupling, motions.depths(seed, reach, coupling.T, ticks))


@dataclass(frozen=True)
class Ticks:
    """Every tick of every run as a separate lane: the state before it, and the result."""

    law: Law
    coupling: Coupling
    before: State
    q_prev: np.ndarray
    p: np.ndarray
    f: np.ndarray
    e: np.ndarray
    q: np.ndarray
    lane: np.ndarray  # which run
    k: np.ndarray  # which tick of it


def ticks(r: Runs, f, e, q) -> Ticks:
    """The ticks of runs (f, e, q as found by the code under test); before the first ones everything is at rest."""
    n_ticks, n = r.p.shape

    def before(v, first):
        return np.concatenate([first[None], v[:-1]]).reshape(-1)

    lane = np.tile(np.arange(n), n_ticks)
    zero = np.zeros(n)
    return Ticks(
        r.law.lanes(lane), r.coupling.lanes(lane),
        State(before(f, zero), before(e, zero), before(r.p, r.p[0])), before(q, r.p[0]),
        r.p.reshape(-1), f.reshape(-1), e.reshape(-1), q.reshape(-1), lane, np.repeat(np.arange(n_ticks), n),
    )  # fmt: skip
