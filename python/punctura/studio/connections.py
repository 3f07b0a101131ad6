"""All connections to the server: how many are allowed, and when one is closed.

A stranger is a connection that has not sent the token. Strangers have a limit of their own, so that they cannot use up
the connections of the user, who has the token. Everything here runs on the server's event loop, behind gate.py.
"""

import asyncio
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from punctura.studio.limits import (
    CLOSE_S,
    FILES_KEPT,
    FILES_WANTED,
    IDLE_S,
    MOST_BUFFERED,
    MOST_KNOWN,
    MOST_STRANGERS,
    STRANGER_S,
    SWEEP_S,
    UNREAD_S,
)

try:
    import resource
except ImportError:  # Windows has no such limit
    resource = None  # type: ignore[assignment]

TOO_LATE = (
    b"HTTP/1.1 408 Request Timeout\r\nContent-Type: text/plain; charset=utf-8\r\nConnection: close\r\n\r\n"
    b"The studio ends a connection that does not show the token of this run in time.\n"
)


@dataclass(eq=False)
class Connection:
    """One TCP connection, in HTTP and after an upgrade to WebSocket. Times are in s, on the clock of Connections."""

    transport: asyncio.Transport
    clock: Callable[[], float]
    known: bool = False  # has sent the token
    socket: bool = False  # has become a WebSocket
    served: int = 0  # requests that are being answered; a WebSocket is one, from its handshake to its close
    since: float = field(init=False)  # accepted, or the last request was answered
    unread_since: float | None = None  # MOST_BUFFERED was reached
    closing_since: float | None = None
    peer: tuple[str, int] = field(init=False)  # address and port of the other end

    def __post_init__(self) -> None:
        self.since = self.clock()
        self.peer = self.transport.get_extra_info("peername")
        self.transport.set_write_buffer_limits(high=MOST_BUFFERED)

    @contextmanager
    def serving(self) -> Iterator[None]:
        self.served += 1
        try:
            yield
        finally:
            self.served -= 1
            if self.known:
                self.since = self.clock()

    def writing(self, possible: bool) -> None:
        """The transport's buffer has become full, or has space again."""
        self.unread_since = None if possible else self.clock()

    def overdue(self, now: float) -> bool:
        if self.transport.is_closing() or (self.socket and not self.served):
            self.closing_since = now if self.closing_since is None else self.closing_since
            # The end of a download may still be on its way.
            patience = UNREAD_S if self.known and not self.socket else CLOSE_S
            return now - self.closing_since >= patience
        if self.unread_since is not None and now - self.unread_since >= UNREAD_S:
            return True
        if not self.known:
            return now - self.since >= STRANGER_S
        return not self.served and now - self.since >= IDLE_S

    def end(self) -> None:
        """Closes at once; unread data is lost. A connection without a complete request gets the reason."""
        if not self.served and not self.known and not self.socket and not self.transport.is_closing():
            self.transport.write(TOO_LATE)
        self.transport.abort()


class Connections:
    """strangers, known: the limits without and with the token."""

    def __init__(self, strangers: int, known: int, clock: Callable[[], float] = time.monotonic) -> None:
        self._most_strangers, self._most_known, self._clock = strangers, known, clock
        # In the order of their arrival: the first stranger is the oldest.
        self.strangers: dict[Connection, None] = {}
        self.known: dict[Connection, None] = {}
        self._by_peer: dict[tuple[str, int], Connection] = {}

    def add(self, transport: asyncio.Transport) -> Connection:
        """Adds a new connection. If there are too many strangers, closes the oldest."""
        connection = Connection(transport, self._clock)
        self.strangers[connection] = None
        self._by_peer[connection.peer] = connection
        if len(self.strangers) > self._most_strangers:
            oldest = next(iter(self.strangers))
            del self.strangers[oldest]
            oldest.end()
        return connection

    def admit(self, connection: Connection) -> bool:
        """The connection has sent the token. Returns False if too many have, or if the connection has ended."""
        if connection.known:
            return True
        if connection.transport.is_closing() or len(self.known) >= self._most_known:
            return False
        self.strangers.pop(connection, None)
        self.known[connection] = None
        connection.known = True
        return True

    def of(self, peer: tuple[str, int] | None) -> Connection | None:
        """The connection to this address and port, as in the scope of a request; None if it has ended."""
        return self._by_peer.get(peer) if peer else None

    def remove(self, connection: Connection) -> None:
        if self._by_peer.get(connection.peer) is connection:  # else a later connection has the same port
            del self._by_peer[connection.peer]
        self.strangers.pop(connection, None)
        self.known.pop(connection, None)

    def sweep(self) -> None:
        """Closes all connections whose deadline has passed."""
        now = self._clock()
        for connection in [c for c in (*self.strangers, *self.known) if c.overdue(now)]:
            connection.end()

    async def watch(self) -> None:
        """Runs until it is cancelled."""
        while True:
            self.sweep()
            await asyncio.sleep(SWEEP_S)


def room(open_files: float) -> tuple[int, int]:
    """The limits for connections without and with the token.

    A connection takes up to two open files: its socket, and the file that it is sent.
    """
    pairs = max(16, int(min(open_files, FILES_WANTED) - FILES_KEPT) // 4)
    return min(MOST_STRANGERS, pairs), min(MOST_KNOWN, pairs)


def open_file_limit() -> float:
    """The limit of open files of this process, after raising it to FILES_WANTED if the system allows that."""
    if resource is None:
        return float(FILES_WANTED)
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    unlimited = resource.RLIM_INFINITY
    wanted = FILES_WANTED if hard == unlimited else min(FILES_WANTED, hard)
    if soft != unlimited and soft < wanted:
        try:
            resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
            soft = wanted
        except (OSError, ValueError):
            pass  # the limit of connections follows the limit of files
    return float("inf") if soft == unlimited else float(soft)
