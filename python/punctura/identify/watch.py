"""Watches the searches for intervals: they may meet parameters that explain the trace better than the fit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from punctura.identify.fit import Fit
from punctura.identify.parameters import Parameters

BETTER = 1.0  # variances of a sample, by which the squares must be less: below that it is the same optimum


class BetterPoint(Exception):
    """Parameters that explain the trace better than the fit, whose optimum is therefore not the best one."""

    def __init__(self, parameters: Parameters) -> None:
        super().__init__("parameters beside the fit explain the trace better than the fit")
        self.parameters = parameters


@dataclass(frozen=True, eq=False)
class Watch:
    """Compares every point of a search with the fit. stops: a better point ends the search with BetterPoint.

    An interval about a lesser optimum says nothing, so the search need not go on.
    """

    fit: Fit
    stops: bool = True

    def met(self, sse: float, parameters: Callable[[], Parameters]) -> None:
        """A point with this sum of squares, N^2. Raises BetterPoint."""
        n, p = self.fit.jacobian.shape
        if self.stops and sse < self.fit.sse * (1 - BETTER / max(n - p, 1)):
            raise BetterPoint(parameters())
