"""One page's socket: its requests in, its messages and frames out."""

import asyncio
import contextlib
import json
from collections.abc import Callable
from concurrent.futures import Future
from typing import NamedTuple

from pydantic import BaseModel, ValidationError
from starlette.websockets import WebSocket, WebSocketDisconnect

from punctura.defects import explain
from punctura.studio.commands import prepare, refusal, sound
from punctura.studio.hub import Hub, Viewer
from punctura.studio.limits import MOST_TEXT
from punctura.studio.session import Session
from punctura.studio.wire.common import ProblemPart
from punctura.studio.wire.messages import Reply, parse_request
from punctura.studio.wire.requests import (
    Awake,
    LoadText,
    NumberedRequest,
    OpenExercise,
    Pause,
    TakeControl,
    Target,
    Took,
)

REFUSED = 1008  # close codes, RFC 6455
FULL = 1013
MOST_ORDERS = 64  # requests that wait for the ones before them; the next ones are refused


class Order(NamedTuple):
    """A request that may take long."""

    request: NumberedRequest
    pauses: int  # number of pauses before it


Orders = asyncio.Queue[Order]


class Closed(Exception):
    """This page must be disconnected; the text says why."""


async def serve_viewer(socket: WebSocket, hub: Hub, session: Session, hello: Callable[[int], BaseModel]) -> None:
    """Runs until the page disconnects or is disconnected."""
    viewer = hub.join(hello)
    if viewer is None:
        await socket.close(FULL, "Too many pages are open.")
        return
    sender = asyncio.create_task(_send(socket, viewer))
    orders: Orders = asyncio.Queue(MOST_ORDERS)
    reader = asyncio.create_task(_read(socket, viewer, hub, session, orders))
    worker = asyncio.create_task(_obey(viewer, hub, session, orders))
    try:
        await asyncio.wait({sender, reader, worker}, return_when=asyncio.FIRST_COMPLETED)
        reason = _reason(reader) or viewer.closed
        if reason:
            sender.cancel()
            with contextlib.suppress(Exception):  # it may be closed already
                await asyncio.wait_for(socket.close(REFUSED, reason[:120]), 2)
    finally:
        if hub.holder == viewer.number:
            session.jobs.post(lambda: sound(session, False))
        hub.leave(viewer)
        for task in (sender, reader, worker):
            task.cancel()
        for ended in await asyncio.gather(sender, reader, worker, return_exceptions=True):
            if isinstance(ended, Exception):
                explain(ended)


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


async def _read(socket: WebSocket, viewer: Viewer, hub: Hub, session: Session, orders: Orders) -> None:
    """Does quick requests at once, above all a pause; the others wait in `orders`.

    It never waits for room there: a pause behind a full queue must be read at once.
    """
    while True:
        message = await socket.receive()
        if message["type"] == "websocket.disconnect":
            await orders.join()  # earlier requests of the page are still done
            return
        text = message.get("text")
        if text is None:
            raise Closed("Requests are text.")
        answer = _answer(text, viewer, hub, session)
        if isinstance(answer, Order) and orders.full():
            answer = _no_room(answer.request)
        if isinstance(answer, Order):
            orders.put_nowait(answer)
        elif answer is not None:
            viewer.put(answer.model_dump_json())


def _answer(text: str, viewer: Viewer, hub: Hub, session: Session) -> Reply | Order | None:
    try:
        request = parse_request(text)
    except ValidationError as error:
        return _not_understood(text, error)
    if len(text) > MOST_TEXT and not isinstance(request, LoadText | OpenExercise):
        raise Closed("The request is too large.")
    if isinstance(request, Target):
        if hub.holder == viewer.number:
            session.target(request)
        return None
    if isinstance(request, Awake):
        if hub.holder == viewer.number:
            session.heard.hear(awake=True)
        return None
    if isinstance(request, Took):
        viewer.took()
        return None
    if isinstance(request, TakeControl):
        hub.take_control(viewer)
        return Reply(id=request.id, ok=True)
    if refused := _refused(request, viewer, hub, session):
        return refused
    if isinstance(request, Pause):
        session.pause()
    return Order(request, session.arming.pauses)


def _no_room(request: NumberedRequest) -> Reply:
    """The reply while the queue is full. A pause has been done already."""
    if isinstance(request, Pause):
        return Reply(id=request.id, ok=True)
    text = f"not done: {MOST_ORDERS} earlier requests of this page still wait; try again when they are done"
    return Reply(id=request.id, ok=False, text=text)


def _refused(request: NumberedRequest, viewer: Viewer, hub: Hub, session: Session) -> Reply | None:
    if hub.holder != viewer.number and not isinstance(request, Pause):  # whoever sees a danger ends the force
        return Reply(id=request.id, ok=False, text="another page has control; take it first")
    if not session.running:
        return Reply(id=request.id, ok=False, text="the run has ended")
    return None


async def _obey(viewer: Viewer, hub: Hub, session: Session, orders: Orders) -> None:
    """Does one order after the other. Another page may have taken control while an order waited."""
    while True:
        order = await orders.get()
        reply = _refused(order.request, viewer, hub, session) or await _do(order, session)
        viewer.put(reply.model_dump_json())
        orders.task_done()


async def _do(order: Order, session: Session) -> Reply:
    request = order.request
    try:
        if isinstance(request, Pause):  # already done; this waits for the worker's earlier jobs
            await asyncio.wrap_future(session.call(lambda: None))
            return Reply(id=request.id, ok=True)
        job = await asyncio.to_thread(prepare, request, session)
        done = await asyncio.wrap_future(session.call(lambda: job(session), order.pauses))
        if isinstance(done, Future):  # finishing a recording may take long
            done = await asyncio.wrap_future(done)
    except Exception as error:
        return refusal(request.id, error)
    text, data = done or ("", {})
    return Reply(id=request.id, ok=True, text=text, data=data)


def _not_understood(text: str, error: ValidationError) -> Reply:
    """A page of another version gets a reply. A message without a request number ends the connection."""
    if len(text) > MOST_TEXT:
        raise Closed("The request is too large.")
    try:
        number = json.loads(text).get("id")
    except (ValueError, AttributeError, RecursionError):
        number = None
    if type(number) is not int or not 0 <= number < 2**53:
        raise Closed("This is no request.")
    problems = [
        ProblemPart(path=".".join(str(p) for p in e["loc"])[:200], value="", reason=e["msg"][:1000])
        for e in error.errors(include_url=False, include_input=False, include_context=False)[:20]
    ]
    return Reply(id=number, ok=False, text="this is no request that the studio knows", problems=problems)
