"""Answers that are made while they are sent, for clients of whom some never read."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Iterator
from typing import Any

from starlette.responses import StreamingResponse
from starlette.types import Receive, Scope, Send


class Download(StreamingResponse):
    """Bytes as they come. When the answer ends, also with its connection (limits.UNREAD_S), its place is free again."""

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

    def _end(self) -> None:
        close = getattr(self._pieces, "close", None)
        if close:
            close()
        if self._place:
            self._place.release()
            self._place = None
