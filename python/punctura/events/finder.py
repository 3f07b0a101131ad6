"""Finds the events of a run, batch by batch."""

from __future__ import annotations

import math
from typing import Any

from numpy.typing import NDArray

from punctura import Scene, _core
from punctura.events.event import Event
from punctura.ticks import Ticks


class EventFinder:
    """Finds events in the order of ticks. The result does not depend on how the ticks are split into batches.

    A batch has columns of Listener.read(). `depth`, `axial_force` and `phase` are required; `tick`, `time`, `lower`,
    `direction`, `axis` and `commands` are optional.
    """

    def __init__(self, scene: Scene, rate: float | None = None) -> None:
        """rate: ticks per second, for runs without a time column; default: the scene's rate. Raises ValueError."""
        if rate is not None and not (math.isfinite(rate) and rate > 0):
            raise ValueError(f"rate must be greater than 0 Hz, not {rate}")
        self._finder = _core.EventFinder(scene, scene.servo.rate if rate is None else rate)

    def __repr__(self) -> str:
        return repr(self._finder)

    def change(self, scene: Scene) -> None:
        """Gives the scene that the run changes to: it applies from the next tick whose commands mark a new scene."""
        self._finder.change(scene)

    def add(self, columns: Ticks | dict[str, NDArray[Any]]) -> list[Event]:
        """The events of the next ticks."""
        return [Event(**found) for found in self._finder.add(columns)]
