"""The seam between asyncio and the HTTP server: limits that no server has as settings. See docs/decisions/server.md.

It uses only what asyncio and RFC 6455 document, so that any server that listens with `loop.create_server` can stand
behind it, in any version.
"""

import asyncio
from collections.abc import Callable
from typing import Any, cast

from punctura.studio.connections import Connection, Connections
from punctura.studio.limits import CLOSE_S, MOST_PONGS, REQUESTS_A_SECOND, REQUESTS_AT_ONCE, Bucket

PONG = b"\x8a"  # first byte of a frame, RFC 6455
_CLOSE, _MASK = 0x88, 0x80
_REASON = (1008).to_bytes(2, "big") + b"Too many requests."
TOO_MANY = bytes([_CLOSE, len(_REASON)]) + _REASON  # to the page
PAGE_CLOSES = bytes([_CLOSE, _MASK | len(_REASON), 0, 0, 0, 0]) + _REASON  # from the page; masked with zeros


class Frames:
    """Finds the frames of a WebSocket in the bytes that come from a client."""

    def __init__(self) -> None:
        self._header = b""  # as far as it has come
        self._left = 0  # bytes of the frame after its header, mask included

    def allowed(self, data: bytes, take: Callable[[], bool]) -> int:
        """How many bytes come before the first frame for which `take` is False."""
        at = 0
        while at < len(data):
            if self._left:
                step = min(self._left, len(data) - at)
                self._left -= step
                at += step
                continue
            if not self._header and not take():
                break
            self._header += data[at : at + 1]
            at += 1
            self._left = self._after_header()
        return at

    def _after_header(self) -> int:
        header = self._header
        if len(header) < 2:
            return 0
        short = header[1] & ~_MASK
        extended = {126: 2, 127: 8}.get(short, 0)
        if len(header) < 2 + extended:
            return 0
        self._header = b""
        return (int.from_bytes(header[2:], "big") if extended else short) + (4 if header[1] & _MASK else 0)


class Gate(asyncio.Protocol):
    """One connection: stands between asyncio's transport and the server's protocol, also after an upgrade."""

    connection: Connection
    transport: asyncio.Transport

    def __init__(self, server: asyncio.BaseProtocol, connections: Connections) -> None:
        self.server = cast(asyncio.Protocol, server)
        self._connections = connections
        self._bucket = Bucket(REQUESTS_A_SECOND, REQUESTS_AT_ONCE)
        self._frames: Frames | None = None  # of a WebSocket
        self.refused = False  # nothing more is read

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self.transport = cast(asyncio.Transport, transport)
        self.connection = self._connections.add(self.transport)
        self.server.connection_made(cast(asyncio.Transport, ServerTransport(self)))

    def connection_lost(self, exc: Exception | None) -> None:
        self._connections.remove(self.connection)
        self.server.connection_lost(exc)

    def pause_writing(self) -> None:
        self.connection.writing(possible=False)
        self.server.pause_writing()

    def resume_writing(self) -> None:
        self.connection.writing(possible=True)
        self.server.resume_writing()

    def eof_received(self) -> bool | None:
        return self.server.eof_received()

    def data_received(self, data: bytes) -> None:
        if self.refused or self.transport.is_closing():
            return
        allowed = self._frames.allowed(data, self._bucket.take) if self._frames else len(data)
        if allowed:  # a server may take no bytes for the end of the stream
            self._feed(data[:allowed])
        if allowed < len(data) and not self.transport.is_closing():
            self.refused = True
            self.transport.write(TOO_MANY)
            self._feed(PAGE_CLOSES)  # so that the application learns of it
            self.transport.resume_reading()  # the page gets the reason only if the rest of what it sends is read
            asyncio.get_running_loop().call_later(CLOSE_S, self.transport.close)

    def _feed(self, data: bytes) -> None:
        try:
            self.server.data_received(data)
        except Exception as error:  # bytes from outside end their own connection only
            asyncio.get_running_loop().call_exception_handler({"message": "the server failed", "exception": error})
            self.transport.abort()

    def upgrade(self, server: asyncio.BaseProtocol) -> None:
        """From here on the connection is a WebSocket, and this is its protocol."""
        self.server = cast(asyncio.Protocol, server)
        self.connection.socket = True
        self._frames = Frames()


class ServerTransport:
    """The transport as the server's protocol sees it."""

    def __init__(self, gate: Gate) -> None:
        self._gate = gate
        self._closed = False

    def __getattr__(self, name: str) -> Any:
        return getattr(self._gate.transport, name)

    def set_protocol(self, protocol: asyncio.BaseProtocol) -> None:
        self._gate.upgrade(protocol)

    def get_protocol(self) -> asyncio.BaseProtocol:
        return self._gate.server

    def is_closing(self) -> bool:
        return self._closed or self._gate.transport.is_closing()

    def write(self, data: bytes) -> None:
        """Drops answers to pings of a page that does not read the earlier ones."""
        transport = self._gate.transport
        pong = self._gate.connection.socket and data[:1] == PONG
        if not (self.is_closing() or self._gate.refused or (pong and transport.get_write_buffer_size() > MOST_PONGS)):
            transport.write(data)

    def close(self) -> None:
        self._closed = True
        if not self._gate.refused:  # else the gate does it
            self._gate.transport.close()


class GatedLoop(asyncio.SelectorEventLoop):
    """An event loop whose servers stand behind gates."""

    def __init__(self, connections: Connections) -> None:
        super().__init__()
        self._connections = connections

    async def create_server(self, protocol_factory: Any, *args: Any, **more: Any) -> asyncio.Server:
        return await super().create_server(lambda: Gate(protocol_factory(), self._connections), *args, **more)
