"""The mass that a needle needs if its force is computed before each step, from the position at its start."""

from __future__ import annotations

from punctura import Coupling


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
