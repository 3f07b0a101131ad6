"""Events of a whole run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from punctura import Scene
from punctura.events.event import Event
from punctura.events.finder import EventFinder
from punctura.ticks import Ticks

if TYPE_CHECKING:
    from punctura.record import Recording


def find_events(recording: Recording | Ticks, scene: Scene | None = None) -> list[Event]:
    """All events of a recording or of Ticks. scene: replaces the recorded scene; Ticks need one.

    Raises RecordingError, TypeError for Ticks without a scene.
    """
    if isinstance(recording, Ticks):
        if scene is None:
            raise TypeError("find_events of Ticks needs the scene of the run: find_events(ticks, scene)")
        return EventFinder(scene).add(recording)
    from punctura.events.recorded import events_of  # a recording is there, so what reads it is loaded

    return events_of(recording, scene)
