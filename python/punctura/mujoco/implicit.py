"""The forces of the needles in a step: implicit or explicit, and where MuJoCo's force sensors see them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from punctura import Coupling
from punctura.mujoco.kinematics import Array

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


class StabilityWarning(UserWarning):
    """A needle is so light, or a time step so long, that an explicit force makes the needle oscillate."""


def smallest_mass(coupling: Coupling, timestep: float, membranes: int = 1) -> float:
    """The mass below which an explicit force is unstable, kg: n (K T^2 + 2 B T) / 4.

    timestep: T, s. membranes: n, the number of membranes that hold the needle at once. At this mass a needle that
    hangs on proxies at rest alternates, x(k+1) = -x(k), in x(k+1) - 2 x(k) + x(k-1) = -n T^2 f(k) / m with (21).
    """
    return membranes * (coupling.stiffness * timestep**2 + 2 * coupling.damping * timestep) / 4


def stability_text(needle: str, mass: float, coupling: Coupling, timestep: float, membranes: int) -> str | None:
    """A warning for a needle with this effective mass, kg; None if it is heavy enough."""
    limit = smallest_mass(coupling, timestep, membranes)
    if mass > limit:
        return None
    return (
        f"site {needle!r} has an effective mass of {mass:.3g} kg. With a time step of {timestep:g} s an explicit force "
        f"needs more than {limit:.3g} kg: m > n (K T^2 + 2 B T) / 4 for n = {membranes} membranes, "
        f"K = {coupling.stiffness:g} N/m and B = {coupling.damping:g} N s/m. The needle can oscillate with a force of "
        "newtons. Use implicit=True, a smaller time step or a heavier needle."
    )


class Applied:
    """Adds the forces of the needles to what the caller has put into data.xfrc_applied, and takes them away again."""

    def __init__(self, pairs: Sequence[tuple[int, int]]) -> None:
        """pairs: body of the needle, body of the tissue, for each link."""
        self._pairs = list(pairs)
        self._bodies = sorted({body for pair in pairs for body in pair} - {0})  # the world does not move
        self._given: Array | None = None
        self._written: Array | None = None

    def put(self, data: Any, points: Array, forces: Array) -> None:
        """Replaces the last forces of the needles. points, forces (L, 3): in the world, m and N, on the needles."""
        rows = data.xfrc_applied[self._bodies]
        if self._written is None or self._given is None or not np.array_equal(rows, self._written):
            self._given = rows
        written = self._given.copy()
        for bodies, point, force in zip(self._pairs, points, forces, strict=True):
            for body, sign in zip(bodies, (1, -1), strict=True):
                if body:
                    row = written[self._bodies.index(body)]
                    row[:3] += sign * force
                    row[3:] += sign * np.cross(point - data.xipos[body], force)
        data.xfrc_applied[self._bodies] = self._written = written

    def take_away(self, data: Any) -> None:
        """Leaves only what the caller has put there."""
        if (
            self._given is not None
            and self._written is not None
            and np.array_equal(data.xfrc_applied[self._bodies], self._written)
        ):
            data.xfrc_applied[self._bodies] = self._given
        self._given = self._written = None
