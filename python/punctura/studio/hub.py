"""Everyone who watches. Each has a queue of its own: who is slow loses their own frames, and nobody else's.

All of it runs on the server's event loop; the worker's thread comes in through `post`.
"""

from __future__ import annotations

import asyncio
import itertools
from collections import deque
from collections.abc import Callable

from pydantic import BaseModel

from punctura.studio.wire.messages import Control, Status

MOST_VIEWERS = 32
MOST_FRAMES = 60  # a second of them; then all that wait are dropped at once, which leaves one gap instead of many
MOST_MESSAGES = 2000  # never dropped: a viewer that leaves so many unread is closed
# What a newcomer is told, in this order; "laws" belongs to the scene before it.
RETAINED = ("scene", "laws", "control", "recording", "exercise", "fault")

Data = str | bytes


class Viewer:
    """One page. `take` gives what to send next; `closed` says why it has to go."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.dropped = 0  # frames
        self.closed = ""
        self._queue: deque[Data] = deque()
        self._frames = self._messages = 0
        self._wake = asyncio.Event()

    def put(self, data: Data) -> None:
        if self.closed:
            return
        if isinstance(data, bytes):
            if self._frames >= MOST_FRAMES:
                self.dropped += self._frames
                self._frames = 0
                self._queue = deque(text for text in self._queue if isinstance(text, str))
            self._frames += 1
        else:
            if self._messages >= MOST_MESSAGES:
                self.close("this page does not read what it is sent")
                return
            self._messages += 1
        self._queue.append(data)
        self._wake.set()

    async def take(self) -> Data | None:
        """The next, in the order of `put`; None when the viewer has to go."""
        while not self._queue and not self.closed:
            self._wake.clear()
            await self._wake.wait()
        if self.closed:
            return None
        data = self._queue.popleft()
        if isinstance(data, bytes):
            self._frames -= 1
        else:
            self._messages -= 1
        return data

    def close(self, reason: str) -> None:
        self.closed = self.closed or reason
        self._queue.clear()
        self._wake.set()

    @property
    def waiting(self) -> int:
        return len(self._queue)


class Hub:
    """Who is there, who has control, and what everyone has to know.

    Control: the first to come has it. When its holder leaves, nobody has it until the next page comes (a page that was
    loaded anew, say) or one takes it.
    """

    def __init__(self) -> None:
        self.viewers: dict[int, Viewer] = {}
        self.holder: int | None = None
        self._numbers = itertools.count(1)
        self._retained: dict[str, BaseModel] = {}
        self._loop: asyncio.AbstractEventLoop | None = None

    def attach(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop

    def post(self, call: Callable[[], None]) -> None:
        """From any thread: `call` on the server's loop. Nothing once that has ended."""
        if self._loop is None:
            return
        try:
            self._loop.call_soon_threadsafe(call)
        except RuntimeError:  # closed: the studio is ending
            self._loop = None

    def frame(self, data: bytes) -> None:
        """From any thread."""
        self.post(lambda: self._put_all(data))

    def say(self, message: BaseModel) -> None:
        """From any thread: to all; kept for those who come later where that is of use."""
        self.post(lambda: self.tell_all(message))

    def tell_all(self, message: BaseModel) -> None:
        kind: str = getattr(message, "kind", "")
        if kind in RETAINED:
            self._retained[kind] = message
        if kind == "scene":
            self._retained.pop("laws", None)
        if isinstance(message, Status):
            self._tell_status(message)
            return
        self._put_all(message.model_dump_json())

    def join(self, hello: Callable[[int], BaseModel]) -> Viewer | None:
        """A new viewer, who is told everything that is; None when there are too many."""
        if len(self.viewers) >= MOST_VIEWERS:
            return None
        viewer = Viewer(next(self._numbers))
        self.viewers[viewer.number] = viewer
        viewer.put(hello(viewer.number).model_dump_json())
        for kind in RETAINED:
            if kind == "control":
                viewer.put(self._control(viewer).model_dump_json())
            elif kind in self._retained:
                message = self._retained[kind]
                if kind == "scene":  # for a newcomer every run is new
                    message = message.model_copy(update={"new_run": True})
                viewer.put(message.model_dump_json())
        if self.holder is None:
            self.take_control(viewer)
        return viewer

    def leave(self, viewer: Viewer) -> None:
        viewer.close("gone")
        self.viewers.pop(viewer.number, None)
        if self.holder == viewer.number:
            self.holder = None
            self._tell_control()

    def take_control(self, viewer: Viewer) -> None:
        self.holder = viewer.number
        self._tell_control()

    def _put_all(self, data: Data) -> None:
        for viewer in self.viewers.values():
            viewer.put(data)

    def _control(self, viewer: Viewer) -> Control:
        return Control(holder=self.holder, you=self.holder == viewer.number)

    def _tell_control(self) -> None:
        for viewer in self.viewers.values():
            viewer.put(self._control(viewer).model_dump_json())

    def _tell_status(self, status: Status) -> None:
        for viewer in self.viewers.values():
            own = status.model_copy(update={"viewers": len(self.viewers), "dropped": viewer.dropped})
            viewer.put(own.model_dump_json())
