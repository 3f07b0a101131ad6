"""The server's log on the terminal: without what a stranger may cause, and without ever waiting for the terminal."""

from __future__ import annotations

import logging
import sys

from websockets.exceptions import InvalidState

from punctura.live import DroppingStream

_STRANGERS = (
    "Invalid HTTP request received",
    "Invalid UTF-8 sequence",
    "socket.send() raised exception",
    "ASGI callable returned without completing handshake",
    "ASGI callable returned without completing response",
)


def _news(record: logging.LogRecord) -> bool:
    error = record.exc_info[1] if record.exc_info else None
    # The server's WebSocket answers text that is no UTF-8 also on a connection that is closing already.
    return not (record.getMessage().startswith(_STRANGERS) or isinstance(error, InvalidState))


def quiet_server() -> None:
    """A program that handles these logs itself goes on doing so."""
    for name in ("uvicorn.error", "asyncio"):
        logger = logging.getLogger(name)
        if _news not in logger.filters:
            logger.addFilter(_news)
        if not logger.hasHandlers() and sys.stderr is not None:
            stream = sys.stderr if isinstance(sys.stderr, DroppingStream) else DroppingStream(sys.stderr)
            logger.addHandler(logging.StreamHandler(stream))
