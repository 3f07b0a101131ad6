"""Builds the core's objects from one lane of random parameters."""

import numpy as np
import punctura
from punctura.scene import ServoSettings

from oracles.random_laws import Parameters


def needle(p: Parameters, lane: int) -> punctura.Needle:
    return punctura.Needle(float(p.diameter[lane]), float(p.tip_angle[lane]))


def membrane(p: Parameters, lane: int) -> punctura.Membrane:
    return punctura.Membrane(
        float(p.stiffness[lane]), float(p.precompression[lane]), float(p.friction[lane]), float(p.thickness[lane])
    )


def law(p: Parameters, lane: int) -> "punctura.ThinLaw | punctura.ThickLaw":
    """The thin law where the thickness is 0, else the thick one."""
    if p.thickness[lane] == 0:
        return punctura.ThinLaw(needle(p, lane), membrane(p, lane))
    return punctura.ThickLaw(needle(p, lane), membrane(p, lane), float(p.obliquity[lane]))


def proxy_1d(r, lane: int, solver: str) -> punctura.Proxy1d:
    """The core's proxy for one lane of random_runs.Runs."""
    c = r.coupling
    coupling = punctura.Coupling(float(c.K[lane]), float(c.B[lane]))
    return punctura.Proxy1d(law(r.parameters, lane), coupling, float(c.T[lane]), solver=solver)


def walk_1d(r, solver: str):
    """(f, e, q), each (ticks, lanes), as the core gives them tick by tick."""
    f, e, q = (np.empty_like(r.p) for _ in range(3))
    for lane in range(r.p.shape[1]):
        proxy = proxy_1d(r, lane, solver)
        for k, p in enumerate(r.p[:, lane].tolist()):
            f[k, lane] = proxy.step(p)
            e[k, lane], q[k, lane] = proxy.offset, proxy.position
    return f, e, q


def proxy_3d(s, lane: int, solver: str) -> punctura.Proxy3d:
    """The core's proxy for one lane of random_scenes.Scenes."""
    c = s.coupling
    return punctura.Proxy3d(
        needle(s.parameters, lane), membrane(s.parameters, lane), s.plane.a[lane].tolist(), s.plane.n[lane].tolist(),
        punctura.Coupling(float(c.K[lane]), float(c.B[lane])), float(c.T[lane]), solver=solver,
    )  # fmt: skip


def walk_3d(s, solver: str):
    """(f, e, q) of (ticks, lanes, 3) and phases (ticks, lanes), as the core gives them tick by tick."""
    shape = (len(s.p), len(s.scene))
    f, e, q = (np.empty((*shape, 3)) for _ in range(3))
    phase = np.empty(shape, dtype=np.uint8)
    for lane, scene in enumerate(s.scene):
        proxy = proxy_3d(s, lane, solver)
        for k in range(len(s.p)):
            f[k, lane] = proxy.step(s.p[k, scene], s.axis[k, scene])
            e[k, lane], q[k, lane], phase[k, lane] = proxy.offset, proxy.position, proxy.phase.value
    return f, e, q, phase


def insertion(s, scene: int, solver: str) -> punctura.Insertion:
    """The core's insertion for one scene of random_scenes.Scenes: low-pass, all its membranes, their sum."""
    lanes = s.members(scene)
    c = s.coupling
    return punctura.Insertion(
        punctura.Scene(
            "random", needle(s.parameters, lanes[0]), punctura.Coupling(float(c.K[lanes[0]]), float(c.B[lanes[0]])),
            [
                punctura.PlacedMembrane(
                    f"m{i}", membrane(s.parameters, lane), s.plane.a[lane].tolist(), s.plane.n[lane].tolist()
                )
                for i, lane in enumerate(lanes)
            ],
            ServoSettings(1 / float(c.T[lanes[0]]), float(s.low_pass[scene]), solver),
        )
    )  # fmt: skip
