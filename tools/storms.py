"""Attacks on a studio by another user of the same computer or by a program with the token. For soak_sockets.py only.

Each storm connects only to loopback, runs in its own process, and ends on request or after the given time.
"""

import base64
import contextlib
import os
import selectors
import socket
import struct
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

try:
    import resource
except ImportError:
    resource = None  # type: ignore[assignment]

PING = bytes([0x89, 0xFD]) + bytes(4) + b"x" * 125  # the longest allowed ping, masked with zeros
PINGS = PING * 500
SPARE_FILES = 100
RATE = 300  # requests per second; more than a studio answers


class Stop(Protocol):
    """An event of this or another process."""

    def is_set(self) -> bool: ...


@dataclass(frozen=True)
class Storm:
    port: int
    token: str  # empty: without
    seconds: float  # at most
    connections: int
    stop: Stop
    began: float = field(default_factory=time.monotonic)

    @property
    def over(self) -> bool:
        return self.stop.is_set() or time.monotonic() - self.began > self.seconds


def open_tcp(storm: Storm) -> socket.socket:
    return socket.create_connection(("127.0.0.1", storm.port), 5)


def upgrade(storm: Storm) -> bytes:
    host, key = f"127.0.0.1:{storm.port}", base64.b64encode(os.urandom(16)).decode()
    return (
        f"GET /ws HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n"
        f"Sec-WebSocket-Protocol: punctura.v1, token.{storm.token or 'wrong'}\r\n\r\n"
    ).encode()


def pings(storm: Storm) -> Counter[str]:
    """Sends pings as fast as possible and reads nothing. Reconnects after a disconnection."""
    counts: Counter[str] = Counter()
    while not storm.over:
        with contextlib.suppress(OSError), open_tcp(storm) as raw:
            counts["connections"] += 1
            raw.sendall(upgrade(storm))
            raw.settimeout(0.2)
            while not storm.over:
                with contextlib.suppress(TimeoutError):
                    counts["bytes"] += raw.send(PINGS)
    return counts


def silent(storm: Storm) -> Counter[str]:
    """Holds `connections` silent connections. Reopens closed ones."""
    return hold(storm, b"")


def sockets(storm: Storm) -> Counter[str]:
    """Holds `connections` silent WebSockets. Reopens closed ones."""
    return hold(storm, upgrade(storm))


def hold(storm: Storm, first: bytes) -> Counter[str]:
    """Keeps `connections` connections open, each of which sends `first`. Also counts the most open at once."""
    more_files(storm.connections)
    counts: Counter[str] = Counter()
    held = selectors.DefaultSelector()
    while not storm.over:
        for _ in range(min(50, storm.connections - len(held.get_map()))):
            with contextlib.suppress(OSError):
                raw = open_tcp(storm)
                raw.sendall(first)
                raw.setblocking(False)
                held.register(raw, selectors.EVENT_READ)
                counts["connections"] += 1
        counts["held at most"] = max(counts["held at most"], len(held.get_map()))
        for key, _ in held.select(0.05):
            drop_if_ended(held, key)
    for key in list(held.get_map().values()):
        key.fileobj.close()  # type: ignore[union-attr]
    return counts


def drop_if_ended(held: selectors.BaseSelector, key: selectors.SelectorKey) -> None:
    raw = key.fileobj
    assert isinstance(raw, socket.socket)
    try:
        ended = not raw.recv(65536)
    except BlockingIOError:
        return
    except OSError:
        ended = True
    if ended:
        held.unregister(raw)
        raw.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        raw.close()


def requests(storm: Storm) -> Counter[str]:
    """Sends RATE requests per second, each on its own connection."""
    counts: Counter[str] = Counter()
    head = f"GET /api/recordings HTTP/1.1\r\nHost: 127.0.0.1:{storm.port}\r\nConnection: close\r\n\r\n".encode()
    sent = 0
    while not storm.over:
        if sent >= RATE * (time.monotonic() - storm.began):
            time.sleep(0.001)
            continue
        sent += 1
        with contextlib.suppress(OSError), open_tcp(storm) as raw:
            raw.sendall(head)
            counts[raw.recv(12)[9:].decode("latin-1")] += 1
    return counts


def more_files(connections: int) -> None:
    """Raises the limit of open files of this process, not of the studio."""
    if resource is not None:
        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        wanted = connections + SPARE_FILES
        if soft < wanted:
            resource.setrlimit(resource.RLIMIT_NOFILE, (min(wanted, hard), hard))


STORMS: dict[str, Callable[[Storm], Counter[str]]] = {
    "pings": pings,
    "silent": silent,
    "sockets": sockets,
    "requests": requests,
}
