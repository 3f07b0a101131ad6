"""The residual of (21)-(23) for a given tick, in newtons. It checks a solution, and does not compute one.

A depth is only known to rounding, so a force is compared with the band over the depths that the double q could stand
for (a few units in its last place). That matters only where Phi is nearly vertical: at a jump of the thin law, which is
read as the set between its two sides, and on slopes above a kilonewton per millimetre.
"""

from dataclasses import dataclass

import numpy as np

from oracles import first_root
from oracles.law import Law, band, breaks
from oracles.proxy_1d import Coupling

ULPS = 4


@dataclass(frozen=True)
class Residual:
    """Lanes of residuals [N]; a solution has them all at rounding."""

    coupling: np.ndarray  # f - K e - B (e - e_prev)/T                                (21)
    place: np.ndarray  # g (q - p - e)                                                 (22)
    friction: np.ndarray  # from f to the edge, or to the band while q stands still     (23)
    earlier: np.ndarray  # how far h is past zero somewhere before q: not the first root

    @property
    def worst(self):
        return np.maximum.reduce([abs(self.coupling), abs(self.place), self.friction, self.earlier])


def reach_of(L: Law, q, slack):
    """((lowest, highest) lower edge, (lowest, highest) upper edge) over the depths [q - slack, q + slack]."""
    places = np.concatenate([(q + slack * side)[:, None] for side in (-1, 0, 1)], axis=1)
    cuts = breaks(L)
    near = abs(cuts - q[:, None]) <= slack[:, None]
    edge = np.spacing(abs(cuts))  # both sides of a jump
    for side in (-1, 0, 1):
        places = np.concatenate([places, np.where(near, cuts + side * edge, q[:, None])], axis=1)
    lower, upper = band(L.lanes(np.s_[:, None]), places)
    return (lower.min(1), lower.max(1)), (upper.min(1), upper.max(1))


def outside(value, low, high):
    """How far value is outside [low, high]."""
    return np.maximum(np.maximum(low - value, value - high), 0)


def residual(L: Law, c: Coupling, p_prev, e_prev, q_prev, p, e, q, f, size=0.0) -> Residual:
    """The residual of one tick per lane; q_prev is the proxy's own position of the tick before.

    size: of the coordinates that the depths were computed from, where those are larger [m].
    """
    slack = ULPS * np.spacing(np.maximum.reduce([abs(p), abs(e), abs(p_prev), abs(e_prev), size + 0 * p]))
    (in_low, in_high), (out_low, out_high) = reach_of(L, q, slack)
    inwards, outwards = q > q_prev + slack, q < q_prev - slack
    friction = np.select(
        [inwards, outwards],
        [outside(f, in_low, in_high), outside(f, out_low, out_high)],
        outside(f, np.minimum(in_low, out_low), np.maximum(in_high, out_high)),
    )
    moving = np.flatnonzero(inwards | outwards)
    earlier = np.zeros_like(q)
    if len(moving):
        ML, Mc, way = L.lanes(moving), c.lanes(moving), inwards[moving]
        q0 = p[moving] + Mc.B * e_prev[moving] / Mc.D
        begin, room = q_prev[moving], slack[moving]
        end = np.where(way, np.maximum(q[moving] - room, begin), np.minimum(q[moving] + room, begin))
        grid = first_root.samples(ML, Mc.g, q0, begin, end, way)
        tall = np.s_[:, None]
        value = first_root.h(ML.lanes(tall), Mc.g[tall], q0[tall], grid, way[tall])
        value = np.where(way[tall], value, -value)
        # The ends themselves: the start may lie on a jump, the end is q. Between them h must not have arrived.
        within = (abs(grid - begin[tall]) > room[tall]) & (abs(grid - end[tall]) > room[tall])
        earlier[moving] = np.maximum(np.where(within, value, 0).max(1), 0)
    return Residual(f - c.K * e - c.B * (e - e_prev) / c.T, c.g * (q - p - e), friction, earlier)
