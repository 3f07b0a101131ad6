"""Runs the studio behind another HTTP server with its public settings, and without gate.py. For soak_sockets.py only.

    python tools/other_servers.py hypercorn run k06-fig12 --device simulated --no-browser

The servers are not among Punctura's packages: docs/decisions/server.md says how to install them.
"""

from __future__ import annotations

import asyncio
import os
import socket
import sys
from types import SimpleNamespace
from typing import Any

import uvicorn
from punctura.cli import main
from punctura.studio import serve
from punctura.studio.connections import Connection, Connections
from punctura.studio.limits import (
    ACCEPTED_AT_ONCE,
    IDLE_S,
    MOST_KNOWN,
    MOST_SCENE_TEXT,
    MOST_STRANGERS,
    REQUESTS_A_SECOND,
    REQUESTS_AT_ONCE,
    STRANGER_S,
    Bucket,
)

MOST = MOST_KNOWN + MOST_STRANGERS
PING_S = 20.0


class Uncounted(Connections):
    """Admits each connection: the server alone limits them."""

    def of(self, peer: tuple[str, int] | None) -> Connection | None:
        transport: Any = SimpleNamespace(
            set_write_buffer_limits=lambda high: None, get_extra_info=lambda name: peer, is_closing=lambda: False
        )
        return Connection(transport, self._clock)


class Other:
    """What StudioServer uses of uvicorn.Server."""

    def __init__(self, config: uvicorn.Config) -> None:
        self.app: Any = config.app
        self.started = self.should_exit = False

    async def until_exit(self, *_: object, **__: object) -> None:
        self.started = True
        while not self.should_exit:
            await asyncio.sleep(0.1)


class Hypercorn(Other):
    async def serve(self, sockets: list[Any]) -> None:
        from hypercorn import Config
        from hypercorn.asyncio import serve as run

        config = Config()
        config.bind = [f"fd://{os.dup(sockets[0].fileno())}"]  # it closes it
        config.errorlog = None
        config.backlog, config.graceful_timeout, config.keep_alive_timeout = ACCEPTED_AT_ONCE, 2, IDLE_S
        config.read_timeout, config.websocket_ping_interval = int(STRANGER_S), PING_S
        config.websocket_max_message_size = MOST_SCENE_TEXT
        await run(self.app, config, shutdown_trigger=self.until_exit)


class Granian(Other):
    async def serve(self, sockets: list[Any]) -> None:
        from granian.constants import HTTPModes, Interfaces
        from granian.http import HTTP1Settings
        from granian.server.embed import Server

        port = sockets[0].getsockname()[1]
        os.dup2(socket.socket().detach(), sockets[0].fileno())  # frees the port: it makes its own socket
        server = Server(
            self.app, "127.0.0.1", port, interface=Interfaces.ASGI, http=HTTPModes.http1, log_enabled=False,
            backlog=128, backpressure=MOST, http1_settings=HTTP1Settings(header_read_timeout=int(1e3 * STRANGER_S)),
        )  # fmt: skip
        running = asyncio.create_task(server.serve())
        await self.until_exit()
        server.stop()
        await running


class Aiohttp(Other):
    """Not for ASGI: this translates. It passes each ping and pong on, so these can be counted here."""

    async def serve(self, sockets: list[Any]) -> None:
        from aiohttp import web

        self.web = web
        lifespan = asyncio.create_task(self.app({"type": "lifespan", "state": {}}, self._starts, self._ignores))
        runner = web.ServerRunner(web.Server(self.answer, keepalive_timeout=IDLE_S, access_log=None))
        await runner.setup()
        await web.SockSite(runner, sockets[0], backlog=ACCEPTED_AT_ONCE).start()
        await self.until_exit()
        lifespan.cancel()
        await runner.cleanup()

    async def _starts(self) -> dict[str, Any]:
        if self.started:
            await asyncio.Event().wait()
        self.started = True
        return {"type": "lifespan.startup"}

    async def _ignores(self, message: dict[str, Any]) -> None:
        pass

    async def answer(self, request: Any) -> Any:
        answer: Any = None
        kind = "websocket" if request.headers.get("upgrade", "").lower() == "websocket" else "http"
        offered = [name.strip() for name in request.headers.get("sec-websocket-protocol", "").split(",")]
        events: asyncio.Queue[dict[str, Any]] = asyncio.Queue()
        events.put_nowait({"type": "websocket.connect"})
        bucket = Bucket(REQUESTS_A_SECOND, REQUESTS_AT_ONCE)

        async def receive() -> dict[str, Any]:
            if kind == "http":
                data = await request.content.readany()
                return {"type": "http.request", "body": data, "more_body": not request.content.at_eof()}
            if not events.empty():
                return events.get_nowait()
            while True:
                message = await answer.receive()
                if message.type in (self.web.WSMsgType.PING, self.web.WSMsgType.PONG) and bucket.take():
                    if message.type is self.web.WSMsgType.PING:
                        await answer.pong(message.data)
                elif message.type is self.web.WSMsgType.TEXT and bucket.take():
                    return {"type": "websocket.receive", "text": message.data}
                else:
                    return {"type": "websocket.disconnect", "code": 1008}

        async def send(message: dict[str, Any]) -> None:
            nonlocal answer
            if message["type"] == "websocket.accept":
                answer = self.web.WebSocketResponse(
                    protocols=[message["subprotocol"]], autoping=False, max_msg_size=MOST_SCENE_TEXT
                )
                await answer.prepare(request)
            elif message["type"].endswith("response.start"):
                headers = [(name.decode(), value.decode()) for name, value in message["headers"]]
                answer = self.web.StreamResponse(status=message["status"], headers=headers)
                await answer.prepare(request)
            elif message["type"].endswith("response.body"):
                await answer.write(message.get("body", b""))
            elif message["type"] == "websocket.send" and message.get("text") is not None:
                await answer.send_str(message["text"])
            elif message["type"] == "websocket.send":
                await answer.send_bytes(message["bytes"])
            else:
                await answer.close(code=message["code"], message=message["reason"].encode())

        headers = [(name.lower(), value) for name, value in request.raw_headers]
        scope = {
            "type": kind, "asgi": {"version": "3.0"}, "http_version": "1.1", "method": request.method,
            "path": request.path, "root_path": "", "query_string": request.query_string.encode(), "headers": headers,
            "client": request.transport.get_extra_info("peername"), "server": None, "scheme": "http",
            "subprotocols": offered, "extensions": {"websocket.http.response": {}}, "state": {},
        }  # fmt: skip
        await self.app(scope, receive, send)
        return answer


class Uvicorn(uvicorn.Server):
    def __init__(self, config: uvicorn.Config) -> None:
        config.limit_concurrency, config.timeout_keep_alive = MOST, int(IDLE_S)
        config.ws_ping_interval = config.ws_ping_timeout = PING_S
        super().__init__(config)


SERVERS: dict[str, Any] = {"uvicorn": Uvicorn, "hypercorn": Hypercorn, "granian": Granian, "aiohttp": Aiohttp}

if __name__ == "__main__":
    serve.uvicorn.Server = SERVERS[sys.argv.pop(1)]
    vars(serve).update(Connections=Uncounted, GatedLoop=lambda connections: asyncio.new_event_loop())
    main()
