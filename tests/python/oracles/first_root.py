"""The first root of g (q - q0) = Phi(q) in the direction of motion, found by sampling and bisection: no closed form.

    h(q) = g (q - q0) - Phi(q)        < 0 where the proxy still wants to slide in, > 0 where it still wants to slide out

Between two breaks of the law h is a parabola at most. Each such piece is sampled at its ends, just inside them, inside,
and at the vertex of the parabola through three samples, so that no pair of roots slips through between two samples.
"""

import numpy as np

from oracles.law import Law, band, breaks

INSIDE = np.linspace(0, 1, 9)
HALVINGS = 90


def h(L: Law, g, q0, q, inwards):
    """Distance of the coupling's force line from the edge of the band that the motion is on [N]."""
    lower, upper = band(L, q)
    return g * (q - q0) - np.where(inwards, lower, upper)


def samples(L: Law, g, q0, begin, end, inwards):
    """Depths (lanes, many) from `begin` to `end` in the order of the motion; between two h hides no sign change."""
    low, high = np.minimum(begin, end), np.maximum(begin, end)
    cuts = np.sort(np.clip(breaks(L), low[:, None], high[:, None]), axis=1)
    cuts = np.concatenate([low[:, None], cuts, high[:, None]], axis=1)
    left, width = cuts[:, :-1, None], np.diff(cuts, axis=1)[:, :, None]
    grid = left + width * INSIDE
    # A jump may sit at either end of a piece: the parabola goes through three inner samples.
    one, two, three = (left + width * x for x in (0.25, 0.5, 0.75))
    wide = np.s_[:, None, None]
    h1, h2, h3 = (h(L.lanes(wide), g[wide], q0[wide], q, inwards[wide]) for q in (one, two, three))
    bend, tilt = h1 - 2 * h2 + h3, (h3 - h1) / 2
    with np.errstate(divide="ignore", invalid="ignore"):
        vertex = np.where(bend != 0, 0.5 - 0.25 * tilt / bend, 0.5)
    right = left + width
    just_inside = [np.nextafter(left, right), np.nextafter(right, left)]  # the far side of a jump at an end
    grid = np.concatenate([grid, left + width * np.clip(np.nan_to_num(vertex), 0, 1), *just_inside], axis=2)
    flat = np.sort(grid.reshape(len(low), -1), axis=1)
    return np.where((begin > end)[:, None], flat[:, ::-1], flat)


def slide(L: Law, g, q0, q_prev, inwards):
    """q of the first root from q_prev inwards or outwards (lanes); at a jump of Phi that h crosses, the jump itself."""
    floor = np.minimum(L.A_O, 0) * (L.X + L.Q) * L.U_by_H  # Phi_O is nowhere below this
    end = np.where(inwards, np.maximum(q0, q_prev), np.minimum(q0 + floor / g, q_prev))
    grid = samples(L, g, q0, q_prev, end, inwards)
    tall = np.s_[:, None]
    value = h(L.lanes(tall), g[tall], q0[tall], grid, inwards[tall])
    arrived = np.where(inwards[tall], value >= 0, value <= 0)
    arrived[:, -1] = True
    arrived[:, 0] = False
    first = np.argmax(arrived, axis=1)
    rows = np.arange(len(q0))
    behind, ahead = grid[rows, first - 1], grid[rows, first]
    for _ in range(HALVINGS):
        middle = (behind + ahead) / 2
        value = h(L, g, q0, middle, inwards)
        there = np.where(inwards, value >= 0, value <= 0)
        behind, ahead = np.where(there, behind, middle), np.where(there, middle, ahead)
    return ahead
