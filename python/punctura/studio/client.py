"""A client for programs that control a studio, for tests and for soak tests. It needs no browser."""

from __future__ import annotations

import http.client
import itertools
import json
import threading
import time
from collections.abc import Callable
from contextlib import ExitStack
from types import TracebackType
from typing import Any, TypeVar
from urllib.parse import parse_qs, quote, urlsplit

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.typing import Origin, Subprotocol

from punctura.results import JsonObject
from punctura.studio.wire.frames import Frame, decode_ticks, split

T = TypeVar("T")
PATIENCE_S = 120.0


class StudioClient:
    """Connects to the address that `punctura run` prints. Keeps all messages, the last frame, and the counts of frames.

        with StudioClient(url) as page:
            page.ask(do="strokes", period=2.0)
            page.wait(lambda: page.of("event"))

    The end of the block closes the connection.
    """

    def __init__(self, url: str, keep_frames: bool = False, patience: float = PATIENCE_S) -> None:
        """keep_frames: whether `frames` keeps all frames. patience: the longest time that `ask` and `wait` wait, s.

        Raises OSError, websockets' exceptions.
        """
        self._patience = patience
        parts = urlsplit(url)
        self.host = f"{parts.hostname}:{parts.port}"
        self.token = parse_qs(parts.query)["token"][0]
        self.messages: list[JsonObject] = []
        self.frames: list[Frame] = []
        self.last: Frame | None = None
        self.ticks = self.gaps = 0  # gaps: frames of a run that do not follow the frame before
        self.run = 0  # of the last scene message
        self.closed: tuple[int, str] | None = None  # code and reason
        self._keep = keep_frames
        self._ids = itertools.count(1)
        self._open = ExitStack()
        self._socket = self._open.enter_context(
            connect(
                f"ws://{self.host}/ws",
                origin=Origin(f"http://{self.host}"),
                subprotocols=[Subprotocol("punctura.v1"), Subprotocol(f"token.{self.token}")],
                compression=None,
                max_size=None,
                ping_interval=None,
                proxy=None,
                open_timeout=patience,
            )
        )
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def __repr__(self) -> str:  # without the token
        return f"<StudioClient of {self.host}: {self.ticks} ticks, closed={self.closed}>"

    def send(self, text: str | bytes) -> None:
        """Sends a message as it is."""
        self._socket.send(text)

    def target(self, position: list[float], axis: list[float], run: int | None = None) -> None:
        """Moves the simulated hand: position, m, and direction. run: its number; by default the present run."""
        number = self.run if run is None else run
        self.send(json.dumps({"do": "target", "run": number, "position": position, "axis": axis}))

    def ask(self, **request: Any) -> JsonObject:
        """Sends a request and returns its reply."""
        number = next(self._ids)
        self.send(json.dumps({"id": number, **request}))
        return self.wait(lambda: next((m for m in self.of("reply") if m["id"] == number), None))

    def of(self, kind: str) -> list[JsonObject]:
        """The messages of one kind so far."""
        return [m for m in list(self.messages) if m["kind"] == kind]

    def status(self) -> JsonObject:
        """The next status message."""
        n = len(self.of("status"))
        return self.wait(lambda: self.of("status")[n:])[0]

    def wait(self, ready: Callable[[], T | None], seconds: float | None = None) -> T:
        """Returns the value of `ready` as soon as it is true. Raises TimeoutError, ConnectionError."""
        end = time.monotonic() + (self._patience if seconds is None else seconds)
        while True:
            found = ready()
            if found:
                return found
            if self.closed:
                raise ConnectionError(f"closed: {self.closed[0]} {self.closed[1]}")
            if time.monotonic() > end:
                raise TimeoutError("the condition did not become true in time")
            time.sleep(0.005)

    def get(self, path: str, method: str = "GET") -> tuple[int, bytes]:
        """Requests an address under /api. Returns status and body. `path` may contain any character."""
        connection = http.client.HTTPConnection(self.host, timeout=self._patience)
        try:
            connection.request(method, quote(path, safe="/?=&%"), headers={"Authorization": f"Bearer {self.token}"})
            answer = connection.getresponse()
            return answer.status, answer.read()
        finally:
            connection.close()

    def json(self, path: str) -> Any:
        """The body of an address under /api, read as JSON. Raises ValueError if the status is not 200."""
        status, body = self.get(path)
        if status != 200:
            raise ValueError(f"{path}: {status} {body.decode(errors='replace').strip()}")
        return json.loads(body)

    def close(self) -> None:
        """Closes the connection."""
        self._open.close()
        self._thread.join()

    def __enter__(self) -> StudioClient:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _read(self) -> None:
        try:
            for data in self._socket:
                if isinstance(data, str):
                    message = json.loads(data)
                    self.run = message["run"] if message["kind"] == "scene" else self.run
                    self.messages.append(message)
                else:
                    for frame in split(data):
                        self._take(decode_ticks(frame))
        except ConnectionClosed:
            pass
        self.closed = (self._socket.close_code or 1006, self._socket.close_reason or "")

    def _take(self, frame: Frame) -> None:
        before = self.last
        if before is not None and before.run == frame.run and before.first_tick + len(before) != frame.first_tick:
            self.gaps += 1
        self.last = frame
        self.ticks += len(frame)
        if self._keep:
            self.frames.append(frame)
