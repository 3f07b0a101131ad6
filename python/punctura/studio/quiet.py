"""What a stranger may cause is no news on the terminal: the server's log keeps what is a defect of the studio's."""

from __future__ import annotations

import logging

_STRANGERS = ("Invalid HTTP request received", "Invalid UTF-8 sequence", "socket.send() raised exception")


def _news(record: logging.LogRecord) -> bool:
    return not record.getMessage().startswith(_STRANGERS)


def quiet_server() -> None:
    for name in ("uvicorn.error", "asyncio"):
        logger = logging.getLogger(name)
        if _news not in logger.filters:
            logger.addFilter(_news)
