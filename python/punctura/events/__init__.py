"""Events at the membranes: touch, pop and exit of the tip (docs/events.md)."""

from punctura.events.finder import Crossing, Event, EventFinder, crossing, find_events

__all__ = ["Crossing", "Event", "EventFinder", "crossing", "find_events"]
