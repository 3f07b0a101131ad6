"""One page's socket: its requests in, its messages and frames out."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

from pydantic import BaseModel, ValidationError
from starlette.websockets import WebSocket, WebSocketDisconnect

from punctura.studio.commands import Done, prepare, refusal
from punctura.studio.hub import Hub, Viewer
from punctura.studio.limits import MOST_TEXT
from punctura.studio.session import Session
from punctura.studio.wire.common import ProblemPart
from punctura.studio.wire.messages import Reply, parse_request
from punctura.studio.wire.requests import LoadText, TakeControl, Target

REFUSED = 1008  # close codes, RFC 6455
FULL = 1013


class Closed(Exception):
    """This page has to go; the text says why."""


async def serve_viewer(socket: WebSocket, hub: Hub, session: Session, hello: Callable[[int], BaseModel]) -> None:
    """Until the page leaves, or has to."""
    viewer = hub.join(hello)
    if viewer is None:
        await socket.close(FULL, "Too many pages are open.")
        return
    sender = asyncio.create_task(_send(socket, viewer))
    reader = asyncio.create_task(_read(socket, viewer, hub, session))
    try:
        await asyncio.wait({sender, reader}, return_when=asyncio.FIRST_COMPLETED)
        reason = _reason(reader) or viewer.closed
        if reason:
            sender.cancel()
            with contextlib.suppress(Exception):  # it may be gone already
                await asyncio.wait_for(socket.close(REFUSED, reason[:120]), 2)
    finally:
        hub.leave(viewer)
        for task in (sender, reader):
            task.cancel()
        await asyncio.gather(sender, reader, return_exceptions=True)


def _reason(reader: asyncio.Task[None]) -> str:
    error = reader.exception() if reader.done() and not reader.cancelled() else None
    return str(error) if isinstance(error, Closed) else ""


async def _send(socket: WebSocket, viewer: Viewer) -> None:
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        while (data := await viewer.take()) is not None:
            if isinstance(data, str):
                await socket.send_text(data)
            else:
                await socket.send_bytes(data)


async def _read(socket: WebSocket, viewer: Viewer, hub: Hub, session: Session) -> None:
    while True:
        message = await socket.receive()
        if message["type"] == "websocket.disconnect":
            return
        text = message.get("text")
        if text is None:
            raise Closed("Requests are text.")
        reply = await _answer(text, viewer, hub, session)
        if reply is not None:
            viewer.put(reply.model_dump_json())


async def _answer(text: str, viewer: Viewer, hub: Hub, session: Session) -> Reply | None:
    try:
        request: Any = parse_request(text)
    except ValidationError as error:
        return _not_understood(text, error)
    if len(text) > MOST_TEXT and not isinstance(request, LoadText):
        raise Closed("The request is too large.")
    if isinstance(request, Target):
        if hub.holder == viewer.number:
            session.target(request)
        return None
    if isinstance(request, TakeControl):
        hub.take_control(viewer)
        return Reply(id=request.id, ok=True)
    if hub.holder != viewer.number:
        return Reply(id=request.id, ok=False, text="another page has control; take it first")
    if not session.running:
        return Reply(id=request.id, ok=False, text="the run has ended")
    try:
        text, data = await _do(request, session)
    except Exception as error:
        reply = refusal(request.id, error)
        return reply or Reply(id=request.id, ok=False, text=f"a defect, please report it: {error!r}")
    return Reply(id=request.id, ok=True, text=text, data=data)


async def _do(request: Any, session: Session) -> Done:
    job = await asyncio.to_thread(prepare, request, session.shelf, session.exercises)
    done = await asyncio.wrap_future(session.call(lambda: job(session)))
    if isinstance(done, Future):  # a recording's file takes its time
        done = await asyncio.wrap_future(done)
    return done or ("", {})


def _not_understood(text: str, error: ValidationError) -> Reply:
    """A page of another version gets an answer; what has no number is nothing of a page's, and ends it."""
    if len(text) > MOST_TEXT:
        raise Closed("The request is too large.")
    try:
        number = json.loads(text).get("id")
    except (ValueError, AttributeError, RecursionError):
        number = None
    if type(number) is not int or not 0 <= number < 2**53:
        raise Closed("This is no request.")
    problems = [
        ProblemPart(path=".".join(str(p) for p in e["loc"])[:200], value="", reason=e["msg"][:200])
        for e in error.errors(include_url=False, include_input=False, include_context=False)[:20]
    ]
    return Reply(id=number, ok=False, text="this is no request that the studio knows", problems=problems)
