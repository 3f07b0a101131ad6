"""What happens at the membranes: the tip touches one, pops through it, leaves it (docs/events.md)."""

from punctura.events.crossing import Crossing, crossing
from punctura.events.event import Event
from punctura.events.finder import EventFinder
from punctura.events.recorded import find_events, snapshot_columns

__all__ = ["Crossing", "Event", "EventFinder", "crossing", "find_events", "snapshot_columns"]
