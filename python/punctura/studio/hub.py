"""All viewers. Each has a queue of its own: a slow viewer gets more frames in a message, or loses its own frames only.

Everything here runs on the server's event loop; the worker's thread uses `post`.
"""

import asyncio
import itertools
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from pydantic import BaseModel

from punctura.studio.hand import Pose
from punctura.studio.limits import MOST_JOINED, MOST_MESSAGES, MOST_ON_WAY, MOST_TICK_BYTES, MOST_VIEWERS, UNREAD_S
from punctura.studio.wire.frames import SEVERAL, joined
from punctura.studio.wire.messages import Control, HandPose, Status

UNREAD = "This page does not read what it is sent."
EVENTS_KEPT = 100  # of the present run, for new viewers
# Of these messages only the newest matters: it takes the place of one that still waits, unless a scene came between.
SUPERSEDED = ("status", "recording", "laws", "exercise", "sitting")
# Messages for a new viewer, in this order; "laws" belongs to the scene before it.
RETAINED = ("sitting", "scene", "laws", "control", "recording", "exercise", "fault")

Data = str | bytes


@dataclass(eq=False)
class Waiting:
    """An entry of a queue."""

    data: Data
    kind: str


class Viewer:
    """One page. `take` returns what to send next; `closed` is the reason for closing."""

    def __init__(self, number: int, clock: Callable[[], float] = time.monotonic) -> None:
        self.number = number
        self._clock = clock
        self.dropped = 0  # frames
        self.closed = ""
        self._queue: deque[Waiting] = deque()
        self._last: dict[str, Waiting] = {}  # of each kind of SUPERSEDED since the last scene, while it waits
        self._ticks = self._bytes = 0  # bytes of frames and of messages in the queue
        self._on_way = 0  # messages with ticks that were taken here and not yet by the page
        self._answers = False  # whether the page says when it has taken one
        self._heard = 0.0  # s, when it last said so
        self._wake = asyncio.Event()

    def put(self, data: Data, kind: str = "") -> None:
        """kind: of a message."""
        if self._waits and self._clock() - self._heard >= UNREAD_S:
            self.close(UNREAD)
        if self.closed:
            return
        if isinstance(data, bytes):
            if self._ticks + len(data) > MOST_TICK_BYTES:
                self._drop_frames()
            self._ticks += len(data)
        else:
            waiting = self._last.get(kind)
            self._bytes += len(data) - (len(waiting.data) if waiting else 0)
            if self._bytes > MOST_MESSAGES:
                self.close(UNREAD)
                return
            if waiting:  # at the end of the queue, a page that reads slowly would never get it
                waiting.data = data
                return
        entry = Waiting(data, kind)
        if kind in SUPERSEDED:
            self._last[kind] = entry
        if kind == "scene":  # what follows belongs to this scene
            self._last.clear()
        self._queue.append(entry)
        self._wake.set()

    def _drop_frames(self) -> None:
        kept = deque(entry for entry in self._queue if isinstance(entry.data, str))
        self.dropped += len(self._queue) - len(kept)
        self._queue, self._ticks = kept, 0

    async def take(self) -> Data | None:
        """What to send next, in the order of `put`; None when the viewer must be closed."""
        while not self.ready and not self.closed:
            self._wake.clear()
            await self._wake.wait()
        if self.closed:
            return None
        entry = self._queue.popleft()
        if isinstance(entry.data, bytes):
            return self._with_the_next(entry.data)
        self._bytes -= len(entry.data)
        if self._last.get(entry.kind) is entry:
            del self._last[entry.kind]
        return entry.data

    def took(self) -> None:
        """The page has taken a message with ticks."""
        self._answers, self._heard = True, self._clock()
        self._on_way = max(0, self._on_way - 1)
        self._wake.set()

    @property
    def ready(self) -> bool:
        """Whether there is something to send now."""
        return bool(self._queue) and not (self._waits and isinstance(self._queue[0].data, bytes))

    @property
    def _waits(self) -> bool:
        """Whether the page must answer before it gets more ticks."""
        return self._answers and self._on_way >= MOST_ON_WAY

    def _with_the_next(self, frame: bytes) -> bytes:
        """A message with this frame, and for a page that answers with those that wait behind it."""
        frames, size = [frame], len(frame)
        while self._answers and self._queue:
            data = self._queue[0].data
            if isinstance(data, str) or size + len(data) > MOST_JOINED:
                break
            frames.append(data)
            size += len(data)
            self._queue.popleft()
        self._ticks -= size
        self._on_way += 1
        return frame if len(frames) == 1 else SEVERAL + joined(frames)

    def close(self, reason: str) -> None:
        self.closed = self.closed or reason
        self._queue.clear()
        self._last.clear()
        self._wake.set()

    @property
    def waiting(self) -> int:
        return len(self._queue)


class Hub:
    """The viewers, who has control, and the present state for new viewers.

    The first viewer has control. When its holder leaves, nobody has control until another page connects (for example
    after a reload) or a page takes it.
    """

    def __init__(self) -> None:
        self.viewers: dict[int, Viewer] = {}
        self.holder: int | None = None
        self.hand: Callable[[], Pose | None] = lambda: (
            None
        )  # the present target; None while strokes or a motion move the hand
        self._numbers = itertools.count(1)
        self._retained: dict[str, BaseModel] = {}
        self._events: deque[BaseModel] = deque(maxlen=EVENTS_KEPT)  # of this run
        self._loop: asyncio.AbstractEventLoop | None = None

    def attach(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop

    def post(self, call: Callable[[], None]) -> None:
        """From any thread: runs `call` on the server's loop. Does nothing once the loop has ended."""
        if self._loop is None:
            return
        try:
            self._loop.call_soon_threadsafe(call)
        except RuntimeError:  # closed: the studio is ending
            self._loop = None

    def frame(self, data: bytes) -> None:
        """From any thread."""
        self.post(lambda: self._put_frame(data))

    def send(self, message: BaseModel) -> None:
        """From any thread: sends to all viewers, and keeps messages that new viewers need."""
        self.post(lambda: self.send_now(message))

    def send_now(self, message: BaseModel) -> None:
        kind: str = getattr(message, "kind", "")
        if kind in RETAINED:
            self._retained[kind] = message
        if kind == "event":
            self._events.append(message)
        if kind == "scene":
            self._retained.pop("laws", None)
            if getattr(message, "new_run", False):
                self._events.clear()
        if isinstance(message, Status):
            self._send_status(message)
            return
        text = message.model_dump_json()
        for viewer in self.viewers.values():
            viewer.put(text, kind)

    def join(self, hello: Callable[[int], BaseModel]) -> Viewer | None:
        """Adds a viewer, who gets the present state; None if there are too many."""
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
                if kind == "scene":  # for a new viewer every run is new
                    message = message.model_copy(update={"new_run": True})
                viewer.put(message.model_dump_json())
        for event in self._events:
            viewer.put(event.model_dump_json())
        if self.holder is None:
            self.take_control(viewer)
        return viewer

    def leave(self, viewer: Viewer) -> None:
        viewer.close("gone")
        self.viewers.pop(viewer.number, None)
        if self.holder == viewer.number:
            self.holder = None
            self._send_control()

    def take_control(self, viewer: Viewer) -> None:
        self.holder = viewer.number
        self._send_control()

    def _put_frame(self, data: bytes) -> None:
        for viewer in self.viewers.values():
            viewer.put(data)

    def _control(self, viewer: Viewer) -> Control:
        you = self.holder == viewer.number
        pose = self.hand() if you else None
        hand = HandPose(position=list(pose[0]), axis=list(pose[1])) if pose else None
        return Control(holder=self.holder, you=you, hand=hand)

    def _send_control(self) -> None:
        for viewer in self.viewers.values():
            viewer.put(self._control(viewer).model_dump_json())

    def _send_status(self, status: Status) -> None:
        for viewer in self.viewers.values():
            own = status.model_copy(update={"viewers": len(self.viewers), "dropped": viewer.dropped})
            viewer.put(own.model_dump_json(), own.kind)
