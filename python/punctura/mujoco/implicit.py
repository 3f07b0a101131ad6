"""The force at the end of a step that the force itself changes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
_PROBE = 1e-8  # m: far below the lengths of a law, far above the rounding of a position
_TOLERANCE = 1e-9  # N, and relative
_NEWTON, _CAREFUL = 12, 40  # iterations


def solve(
    respond: Callable[[Array], Array], free: Array, compliance: Array, guess: Array, steepest: float
) -> tuple[Array, Array]:
    """Solves f = respond(free + compliance f). Returns the positions (L, 3) in m and the forces there (L, 3) in N.

    respond: the force on each of L needles at given positions; needle i depends on position i only. free (L, 3): the
    positions at the end of the step without the forces, m. compliance (3 L, 3 L): m/N. guess (L, 3): forces, N.
    steepest: largest stiffness of `respond`, N/m.

    Newton's method with difference quotients: exact after one iteration while all proxies stick. If it does not get
    closer, for example at a pop, where the force jumps, a slower iteration follows that never overshoots. Positions and
    forces always fit together, also if the tolerance is not reached.
    """
    f = guess.ravel()
    best: tuple[float, Array, Array] | None = None
    eye = np.eye(f.size)
    for i in range(_NEWTON + _CAREFUL):
        p = free + (compliance @ f).reshape(free.shape)
        force = respond(p)
        residual = f - force.ravel()
        size = float(np.abs(residual).max())
        if best is None or size < best[0]:
            best = size, p, force
        if size <= _TOLERANCE * (1 + float(np.abs(f).max())):
            break
        slope = _slope(respond, p, force) if i < _NEWTON else -steepest * eye
        f = f - np.linalg.solve(eye - slope @ compliance, residual)
    assert best is not None
    return best[1], best[2]


def _slope(respond: Callable[[Array], Array], p: Array, force: Array) -> Array:
    """d force / d position, (3 L, 3 L), block by block."""
    count = len(p)
    slope = np.zeros((3 * count, 3 * count))
    for axis in range(3):
        moved = p.copy()
        moved[:, axis] += _PROBE
        column = (respond(moved) - force) / _PROBE
        for i in range(count):
            slope[3 * i : 3 * i + 3, 3 * i + axis] = column[i]
    return slope
