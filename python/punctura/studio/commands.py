"""What each request of a page does. In the worker's thread."""

from __future__ import annotations

import time
from typing import Any

from punctura.errors import ConfigurationError
from punctura.scene import scene_names
from punctura.studio.loaded import from_name, from_tables, from_text, problem_parts
from punctura.studio.session import Session
from punctura.studio.wire import requests as ask
from punctura.studio.wire.messages import Reply


class NotNow(ValueError):
    """Something that cannot be done as things are; the text says why."""


def obey(session: Session, request: Any) -> Reply:
    """Does it. What is refused is a reply that says why; nothing is raised for a reason of the page's."""
    try:
        text, data = _do(session, request)
    except ConfigurationError as error:
        count = len(error.problems)
        words = f"{count} problem{'s' if count != 1 else ''}"
        return Reply(id=request.id, ok=False, text=words, problems=problem_parts(error))
    except (ValueError, RuntimeError, OSError) as error:  # DeviceError and RecordingError are of these
        return Reply(id=request.id, ok=False, text=str(error))
    return Reply(id=request.id, ok=True, text=text, data=data)


def _do(session: Session, request: Any) -> tuple[str, dict[str, Any]]:
    text = ""
    data: dict[str, Any] = {}
    match request:
        case ask.Arm():
            session.arm()
        case ask.Pause():
            session.pause()
        case ask.Reset():
            session.reset()
        case ask.Strokes():
            _needs_simulated(session)
            session.hand.strokes(session.run.loaded.scene, request.period, time.monotonic())
        case ask.Edit():
            session.edit(from_tables(request.tables))
        case ask.Load():
            if request.scene not in scene_names():
                raise NotNow(f"there is no ready scene {request.scene!r}")
            session.begin(from_name(request.scene))
        case ask.LoadText():
            session.begin(from_text(request.toml))
        case ask.Compare():
            session.set_compare(request.on)
        case ask.TripFault():
            _needs_simulated(session).trip()
        case _:
            raise NotNow("this studio cannot do that")
    return text, data


def _needs_simulated(session: Session) -> Any:
    if not session.bench.simulated:
        raise NotNow("only a simulated device has a hand that can be moved from here")
    return session.bench.device
