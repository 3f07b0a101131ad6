"""Responses with JSON, and those that are produced while they are sent; some clients never read them."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Iterator
from typing import Any

from pydantic_core import to_json
from starlette.responses import Response, StreamingResponse
from starlette.types import Receive, Scope, Send


def json_of(answer: object) -> Response:
    """A model, or a list of models, of wire_schema.Answer."""
    return Response(to_json(answer), media_type="application/json")


class Download(StreamingResponse):
    """Sends bytes as they come. Releases its slot when the response ends, also if the connection ends first."""

    def __init__(self, pieces: Iterator[bytes], place: threading.BoundedSemaphore | None = None, **more: Any) -> None:
        """Produces the first piece at once, so that an error in the file shows before the response begins.

        place: a slot that the caller has acquired. It is released when the response ends or cannot begin.
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
