"""Finds the events in a run, batch by batch."""

from __future__ import annotations

from typing import Any

from numpy.typing import NDArray

from punctura import Scene, _core
from punctura.events.event import Event
from punctura.ticks import Ticks


class EventFinder:
    """Events of a run, in the order of ticks, however its ticks are cut into batches.

    A batch has the columns of Listener.read(); of them `depth`, `axial_force` and `phase` are needed, `tick`, `time`,
    `lower`, `direction`, `axis` and `commands` used where they are there.
    """

    def __init__(self, scene: Scene, rate: float | None = None) -> None:
        """rate: ticks a second, for runs that do not tell the time; the scene's own if not given."""
        self._finder = _core.EventFinder(scene, rate or scene.servo.rate)

    def __repr__(self) -> str:
        return repr(self._finder)

    def change(self, scene: Scene) -> None:
        """The run goes on in another scene, from the next tick on that says that it has taken one."""
        self._finder.change(scene)

    def add(self, columns: Ticks | dict[str, NDArray[Any]]) -> list[Event]:
        """The events of the next ticks."""
        return [Event(**found) for found in self._finder.add(columns)]
