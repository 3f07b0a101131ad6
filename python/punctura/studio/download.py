"""Answers that are made while they are sent, for clients of whom some never read."""

from __future__ import annotations

import asyncio
import itertools
import threading
from collections.abc import Iterator
from typing import Any

from starlette.responses import StreamingResponse
from starlette.types import Message, Receive, Scope, Send

STALL_S = 60.0  # for a client that takes nothing any more
MOST_EXPORTS = 4  # at a time: each keeps a core busy while it is read, and some megabytes while it is not


class Download(StreamingResponse):
    """Bytes as they come. One whose client takes none for STALL_S ends, and its place is free again."""

    def __init__(self, pieces: Iterator[bytes], place: threading.BoundedSemaphore | None = None, **more: Any) -> None:
        """The first piece is made at once: what is wrong with a file shows before the answer begins.

        place: one that the caller has acquired. It is released when the answer has ended, or cannot begin.
        """
        self._pieces, self._place = pieces, place
        try:
            first = list(itertools.islice(pieces, 1))
        except BaseException:
            self._end()
            raise
        super().__init__(itertools.chain(first, pieces), **more)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            await super().__call__(scope, receive, send)
        finally:
            self._end()

    async def stream_response(self, send: Send) -> None:
        async def within(message: Message) -> None:
            await asyncio.wait_for(send(message), STALL_S)

        try:
            await super().stream_response(within)
        except asyncio.TimeoutError:
            return  # without its end: the server closes the connection

    def _end(self) -> None:
        close = getattr(self._pieces, "close", None)
        if close:
            close()
        if self._place:
            self._place.release()
            self._place = None
