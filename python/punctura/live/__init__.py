"""A scene on a device, now: what `punctura run` does, for programs."""

from punctura.live.motion import strokes_through
from punctura.live.session import Ended, run_live
from punctura.live.summary import RunSummary

__all__ = ["Ended", "RunSummary", "run_live", "strokes_through"]
