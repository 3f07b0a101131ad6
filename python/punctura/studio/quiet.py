"""The server's log on the terminal: it skips messages that strangers cause, and never waits for the terminal.

Its tracebacks go to the log of defects, too.
"""

from __future__ import annotations

import logging
import sys

from h11 import LocalProtocolError
from websockets.exceptions import InvalidState

from punctura.defects import explain
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
    # The server's WebSocket answers text that is not UTF-8 even on a connection that is closing, and the application
    # answers a request after the server has ended the connection, because the rest of the request is no HTTP.
    closing = isinstance(error, InvalidState) or (
        isinstance(error, LocalProtocolError) and str(error).endswith("state=MUST_CLOSE")
    )
    return not (closing or record.getMessage().startswith(_STRANGERS))


class _Defects(logging.Handler):
    def emit(self, record: logging.LogRecord) -> None:
        if record.exc_info and record.exc_info[1]:
            explain(record.exc_info[1])


def quiet_server() -> None:
    """Keeps the log handlers of a program that has installed its own."""
    for name in ("uvicorn.error", "asyncio"):
        logger = logging.getLogger(name)
        if _news not in logger.filters:
            logger.addFilter(_news)
        if not logger.hasHandlers() and sys.stderr is not None:
            stream = sys.stderr if isinstance(sys.stderr, DroppingStream) else DroppingStream(sys.stderr)
            logger.addHandler(logging.StreamHandler(stream))
        if not any(isinstance(handler, _Defects) for handler in logger.handlers):
            logger.addHandler(_Defects())
