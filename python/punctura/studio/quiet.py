"""What a stranger may cause is no news on the terminal: the server's log keeps what is a defect of the studio's."""

from __future__ import annotations

import logging

from websockets.exceptions import InvalidState

_STRANGERS = (
    "Invalid HTTP request received",
    "Invalid UTF-8 sequence",
    "socket.send() raised exception",
    "ASGI callable returned without completing handshake",
)


def _news(record: logging.LogRecord) -> bool:
    error = record.exc_info[1] if record.exc_info else None
    # The server's WebSocket answers text that is no UTF-8 also on a connection that is closing already.
    return not (record.getMessage().startswith(_STRANGERS) or isinstance(error, InvalidState))


def quiet_server() -> None:
    for name in ("uvicorn.error", "asyncio"):
        logger = logging.getLogger(name)
        if _news not in logger.filters:
            logger.addFilter(_news)
