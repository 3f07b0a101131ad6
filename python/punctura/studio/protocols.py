"""uvicorn's protocols for HTTP and WebSocket, with the limits that uvicorn does not have."""

from __future__ import annotations

import asyncio
from inspect import isfunction
from typing import Any

from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.frames import Frame
from websockets.protocol import State

from punctura.studio.connections import Connection, Connections
from punctura.studio.limits import CLOSE_S, MOST_PONGS, REQUESTS_A_SECOND, REQUESTS_AT_ONCE, Bucket

CONNECTIONS = "punctura.connections"  # in the state of the application, which uvicorn gives to each protocol
CONNECTION = "punctura.connection"  # in the state of each request
SLICE = 4096  # bytes parsed at a time: a frame has 6 or more of them, so that little is parsed beyond the limit
REFUSED = 1008  # close code, RFC 6455


class Watched(asyncio.Protocol):
    """Tells its connection when nothing more can be written, and Connections when it has ended."""

    app_state: dict[str, Any]
    connection: Connection

    def connection_lost(self, exc: Exception | None) -> None:
        super().connection_lost(exc)
        self.app_state[CONNECTIONS].remove(self.connection)

    def pause_writing(self) -> None:
        super().pause_writing()
        self.connection.writing(possible=False)

    def resume_writing(self) -> None:
        super().resume_writing()
        self.connection.writing(possible=True)


class BoundedHttp(Watched, H11Protocol):
    """An HTTP protocol whose connection is counted and limited."""

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        connections: Connections = self.app_state[CONNECTIONS]
        self.connection = connections.add(transport)
        self.app_state = {**self.app_state, CONNECTION: self.connection}  # also for the WebSocket after an upgrade


class BoundedSocket(Watched, WebSocketsSansIOProtocol):
    """Counts frames of every kind; does not answer pings of a page that does not read the answers."""

    def __init__(self, *args: Any, **more: Any) -> None:
        super().__init__(*args, **more)
        self.connection = self.app_state[CONNECTION]
        self.bucket = Bucket(REQUESTS_A_SECOND, REQUESTS_AT_ONCE)
        self.refused = False
        self.close_timeout = CLOSE_S

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        super().connection_made(transport)
        self.connection.socket = True

    def data_received(self, data: bytes) -> None:
        for at in range(0, len(data), SLICE):
            if self.refused or self.transport.is_closing():
                return
            super().data_received(data[at : at + SLICE])

    def handle_text(self, event: Frame) -> None:
        if self._counted():
            super().handle_text(event)

    def handle_bytes(self, event: Frame) -> None:
        if self._counted():
            super().handle_bytes(event)

    def handle_cont(self, event: Frame) -> None:
        if self._counted():
            super().handle_cont(event)

    def handle_pong(self, event: Frame) -> None:
        if self._counted():
            super().handle_pong(event)

    def handle_ping(self) -> None:
        if not self._counted():
            return
        if self.close_sent or self.transport.get_write_buffer_size() > MOST_PONGS:
            self.conn.data_to_send()  # the pongs are taken and not sent
        else:
            super().handle_ping()

    def _counted(self) -> bool:
        """False if there are too many frames. The page gets the reason, and nothing more is read."""
        if not self.refused and not self.bucket.take():
            self.refused = True
            self.conn.data_to_send()
            if not self.close_sent and self.conn.state is State.OPEN:
                self.conn.send_close(REFUSED, "Too many requests.")
                self.transport.write(b"".join(self.conn.data_to_send()))
                self.close_sent = True
                self.close_timer = self.loop.call_later(CLOSE_S, self.transport.close)
            self.queue.put_nowait({"type": "websocket.disconnect", "code": REFUSED})
        return not self.refused


def check_overrides(bounded: type, base: type) -> None:
    """Raises ImportError if a method of `bounded` overrides nothing, because uvicorn would never call it."""
    missing = [
        name for name, what in vars(bounded).items() if isfunction(what) and name[0] != "_" and not hasattr(base, name)
    ]
    if missing:
        raise ImportError(
            f"{base.__module__}.{base.__name__} has no {', '.join(missing)}, so limits of the studio would not act. "
            "Install the version that Punctura was tested with: python -m pip install 'uvicorn>=0.54,<0.55'"
        )


check_overrides(Watched, H11Protocol)
check_overrides(Watched, WebSocketsSansIOProtocol)
check_overrides(BoundedHttp, H11Protocol)
check_overrides(BoundedSocket, WebSocketsSansIOProtocol)
