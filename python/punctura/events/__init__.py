"""Events at the membranes: touch, pop and exit of the tip (docs/events.md)."""

from punctura.events.crossing import Crossing, crossing
from punctura.events.event import Event
from punctura.events.find import find_events
from punctura.events.finder import EventFinder

__all__ = ["Crossing", "Event", "EventFinder", "crossing", "find_events"]
