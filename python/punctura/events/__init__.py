"""Events at the membranes: touch, pop and exit of the tip (docs/events.md)."""

from punctura.events.crossing import Crossing, crossing
from punctura.events.event import Event
from punctura.events.finder import EventFinder
from punctura.events.recorded import find_events

__all__ = ["Crossing", "Event", "EventFinder", "crossing", "find_events"]
