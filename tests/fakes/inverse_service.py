"""A simulated Inverse Service on its own port, for any WebSocket client.

It behaves like the real service: after connecting it sends one inventory, then exactly one state for each message. A
force lasts until the next message, but not longer than `persists`. The WebSocket is that of the library websockets,
independent of Punctura's own.
"""

import asyncio
import http
import json
import math
import threading
from dataclasses import dataclass, field
from typing import Any

import websockets
from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.http11 import Request, Response

DOWN = {"w": math.sqrt(0.5), "x": -math.sqrt(0.5), "y": 0.0, "z": 0.0}  # the grip's +y points down


@dataclass
class Arm:
    """A tip of 95 g on a hand's spring at `hand`; x right, y away, z up, in m and N. One step per message."""

    hand: list[float] = field(default_factory=lambda: [0.0, -0.12, 0.15])
    position: list[float] = field(default_factory=lambda: [0.0, -0.12, 0.15])
    velocity: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    force: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])

    def step(self, period: float, mass: float = 0.095, stiffness: float = 500.0, damping: float = 8.0) -> None:
        for i in range(3):
            pull = stiffness * (self.hand[i] - self.position[i]) - damping * self.velocity[i]
            self.velocity[i] += period * (pull + self.force[i]) / mass
            self.position[i] += period * self.velocity[i]


@dataclass
class InverseService:
    """`removed` and `id` may be set during a run."""

    version: str = "3.5.2"
    takes: str = "vector"
    strict: bool = False  # a command under another key closes the connection, instead of giving no force
    period: float = 1 / 1600
    persists: float = 0.01
    removed: bool = False
    id: str = "049D"
    arm: Arm = field(default_factory=Arm)
    messages: list[dict[str, Any]] = field(default_factory=list)
    idle: threading.Event = field(default_factory=threading.Event)  # set while nobody commands a force

    def state(self, config: bool = False) -> str:
        def xyz(v: list[float]) -> dict[str, float]:
            return dict(zip("xyz", v, strict=True))

        arm: dict[str, Any] = {
            "device_id": self.id,
            "state": {
                "cursor_position": xyz(self.arm.position),
                "cursor_velocity": xyz(self.arm.velocity),
                "current_cursor_force": xyz(self.arm.force),
                "angular_position": {"a0": 0.0, "a1": 0.0, "a2": 0.0},
                "control_domain": "cartesian",
                "control_mode": "force",
                "mode": "force",  # older clients insist on it
            },
            "status": {"calibrated": True, "in_use": False, "power_supply": True, "ready": True, "started": True},
        }
        if config:
            arm["config"] = {"type": "inverse3", "handedness": "right", "preset": "defaults"}
        grip = {
            "device_id": "1102",
            "state": {"orientation": DOWN, "buttons": {"a": False, "b": False, "c": False}, "hall": 16},
            "status": {"connected": True, "awake": True, "ready": True},
        }
        arms = [] if self.removed else [arm]
        return json.dumps({"session_id": 7, "inverse3": arms, "verse_grip": [], "wireless_verse_grip": [grip]})

    def obey(self, message: dict[str, Any]) -> bool:
        """Executes a command. Returns False if it is refused."""
        if len(self.messages) < 100:
            self.messages.append(message)
        self.arm.force = [0.0, 0.0, 0.0]
        for device in message.get("inverse3", []):
            command = device.get("commands", {}).get("set_cursor_force")
            if command is not None and self.takes in command:
                # Forces of several commands add.
                self.arm.force = [f + float(command[self.takes][a]) for f, a in zip(self.arm.force, "xyz", strict=True)]
            elif command is not None and self.strict:
                return False
        if any(self.arm.force):
            self.idle.clear()
        else:
            self.idle.set()
        self.arm.step(self.period)
        return True

    def relax(self) -> None:
        self.arm.force = [0.0, 0.0, 0.0]
        self.idle.set()

    async def speak(self, client: ServerConnection) -> None:
        try:
            await client.send(self.state(config=True))
            while True:
                try:
                    text = await asyncio.wait_for(client.recv(), self.persists)
                except asyncio.TimeoutError:
                    self.relax()  # commands do not persist
                    continue
                if not self.obey(json.loads(text)):
                    await client.close(1008, f"set_cursor_force takes {self.takes!r}")
                else:
                    await client.send(self.state())
        except websockets.ConnectionClosed:
            pass
        finally:
            self.relax()

    def plain_http(self, connection: ServerConnection, request: Request) -> Response | None:
        if request.path == "/version":
            return connection.respond(http.HTTPStatus.OK, json.dumps({"version": self.version}) + "\n")
        if request.path == "/devices":
            return connection.respond(http.HTTPStatus.OK, self.state(config=True) + "\n")
        return None

    async def start(self, port: int = 0) -> Server:
        return await serve(
            self.speak, "127.0.0.1", port, process_request=self.plain_http, compression=None, close_timeout=0.2
        )


class Running:
    """Runs a service on its own thread: `with Running(InverseService()) as url`."""

    def __init__(self, service: InverseService) -> None:
        self.service = service
        self.url = ""
        self._ready = threading.Event()
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._run, daemon=True)

    def _run(self) -> None:
        async def begin() -> Server:
            return await self.service.start()

        self._server = self._loop.run_until_complete(begin())
        self.url = f"ws://127.0.0.1:{next(iter(self._server.sockets)).getsockname()[1]}"
        self._ready.set()
        self._loop.run_forever()

    def __enter__(self) -> str:
        self._thread.start()
        self._ready.wait()
        return self.url

    def __exit__(self, *_: object) -> None:
        async def end() -> None:
            self._server.close()
            await self._server.wait_closed()

        asyncio.run_coroutine_threadsafe(end(), self._loop).result()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()


async def main() -> None:
    """At the usual port, for other clients."""
    await (await InverseService().start(10001)).serve_forever()


if __name__ == "__main__":
    asyncio.run(main())
