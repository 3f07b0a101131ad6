"""Runs the studio: the worker, and the server on loopback, until a signal comes or the duration is over."""

import asyncio
import os
import secrets
import socket
import sys
import threading
import time
import webbrowser
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import uvicorn

from punctura._core import DeviceError, PuncturaError
from punctura.defects import explain
from punctura.exercise import ResultStore
from punctura.live.supervisor import Supervisor
from punctura.process.dropping_stream import terminal
from punctura.process.signals import ends_on_signals
from punctura.studio.app import NO_PAGE, Studio, build_app, likely_folders
from punctura.studio.catalog import Exercises
from punctura.studio.connections import Connections, open_file_limit, room
from punctura.studio.gate import GatedLoop
from punctura.studio.hub import Hub
from punctura.studio.limits import ACCEPTED_AT_ONCE, LISTEN_QUEUE, MOST_SCENE_TEXT
from punctura.studio.loaded import Loaded
from punctura.studio.own_exercises import OwnExercises
from punctura.studio.run import Settings
from punctura.studio.session import Session
from punctura.studio.shelf import Shelf, default_folder

PAGE = Path(__file__).parent / "page"
TOKEN_VARIABLE = "PUNCTURA_STUDIO_TOKEN"


class StudioError(PuncturaError, OSError):
    """The server cannot start; the text says what to do."""


@dataclass(frozen=True)
class Address:
    """The server's address. port: 0 picks a free one."""

    port: int
    token: str

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}/?token={self.token}"


class StudioServer:
    """The studio in threads of its own, for the command line and for tests: `start`, `stop`."""

    def __init__(
        self,
        loaded: Loaded,
        settings: Settings,
        port: int = 0,
        token: str = "",
        page: Path = PAGE,
        folder: Path | None = None,
        exercises: Exercises | None = None,
    ) -> None:
        """Raises StudioError if the port is in use, DeviceError if there is no device, ConfigurationError."""
        self._socket = _listening(port)
        try:
            self.hub = Hub()
            shelf = Shelf(folder or default_folder())
            results = ResultStore(shelf.folder / "results" if folder else shelf.folder.parent / "results")
            self.session = Session(loaded, settings, self.hub, shelf, results, exercises)
            self.session.exercises.own = OwnExercises((folder or shelf.folder.parent) / "exercises")
            self.hub.hand = lambda: self.session.hand.pose
        except BaseException:
            self._socket.close()
            raise
        self.address = Address(self._socket.getsockname()[1], token or secrets.token_urlsafe(24))
        self.studio = Studio(self.session, self.hub, page, self.address.token, likely_folders())
        self.connections = Connections(*room(open_file_limit()))
        self.guard = build_app(self.studio, self.address.port, self.address.token, self.connections, report_defect)
        config = uvicorn.Config(
            self.guard,
            http="h11",
            ws="websockets-sansio",
            ws_max_size=MOST_SCENE_TEXT,
            ws_per_message_deflate=False,
            ws_ping_interval=None,
            log_config=None,
            log_level="critical",  # the rest are messages that strangers cause; the guard reports defects
            access_log=False,
            server_header=False,
            proxy_headers=False,
            timeout_graceful_shutdown=2,
            backlog=ACCEPTED_AT_ONCE,
        )
        self._server = uvicorn.Server(config)
        self._thread = threading.Thread(target=self._serve, name="punctura-server", daemon=True)

    def _serve(self) -> None:
        """As asyncio.run(), which takes no loop of one's own before Python 3.12."""
        loop = GatedLoop(self.connections)
        loop.set_exception_handler(lambda _, context: report_defect(context.get("exception")))
        try:
            loop.run_until_complete(self._server.serve(sockets=[self._socket]))
        finally:
            if tasks := asyncio.all_tasks(loop):
                for task in tasks:
                    task.cancel()
                loop.run_until_complete(asyncio.wait(tasks))
            loop.run_until_complete(loop.shutdown_asyncgens())
            loop.run_until_complete(loop.shutdown_default_executor())
            loop.close()

    def start(self) -> None:
        """Returns when the server answers and ticks come."""
        self._thread.start()
        while not self._server.started:
            if not self._thread.is_alive():
                raise StudioError("the server did not start")
            time.sleep(0.01)
        self._socket.listen(LISTEN_QUEUE)  # uvicorn has set it to the backlog for accepting
        self.session.start()

    @property
    def running(self) -> bool:
        return self._thread.is_alive() and self.session.running

    def stop(self) -> None:
        """Ends the force first, then the pages."""
        self.session.stop()
        self._server.should_exit = True
        if self._thread.is_alive():
            self._thread.join()
        self._socket.close()
        if self.session.sitting:
            self.session.sitting.close()


def run_studio(
    make: Callable[[], StudioServer],
    browser: bool = True,
    duration: float | None = None,
    report: Callable[[str], None] = print,
) -> None:
    """Serves until a signal, which raises Ended after the force is off, or for `duration` (s). Raises StudioError.

    A separate thread ends the run in time, even while `report` or the browser blocks this one.
    """
    with ends_on_signals() as signals:
        with signals.raised():
            server = make()
        supervisor = Supervisor(signals, server.start, lambda: not server.running, server.session.stop, duration)
        try:
            supervisor.start()
            with signals.raised():
                report(server.address.url)
                if browser:
                    open_page(server.address.url)
                supervisor.wait()
        finally:
            try:
                supervisor.stop()
            finally:
                server.stop()
    if isinstance(server.session.failure, DeviceError):
        raise server.session.failure
    if server.session.failure:
        raise RuntimeError("the studio's worker has ended") from server.session.failure


def report_defect(error: BaseException | None) -> None:
    """Logs what nobody foresaw, with one line on the terminal. From any thread; never waits."""
    if error and (text := explain(error)):
        print(f"punctura: {text}", file=terminal())


def need_page(page: Path) -> None:
    """Raises StudioError where there is none."""
    if not (page / "index.html").is_file():
        raise StudioError(NO_PAGE)


def token_from_environment() -> str:
    """A token from the environment, so that a page can reconnect to a restarted studio; else empty."""
    token = os.environ.get(TOKEN_VARIABLE, "")
    if token and (len(token) < 16 or not token.replace("-", "").replace("_", "").isalnum()):
        raise StudioError(f"{TOKEN_VARIABLE} must have 16 or more letters, digits, - or _")
    return token


def open_page(url: str) -> None:
    """Opens a graphical browser, if there is one; a text browser would take over the terminal."""
    windows = sys.platform in ("win32", "darwin") or any(os.environ.get(v) for v in ("DISPLAY", "WAYLAND_DISPLAY"))
    if windows:
        webbrowser.open(url)


def _listening(port: int) -> socket.socket:
    # The protocol is named because only then asyncio sets TCP_NODELAY; without it frames are up to 40 ms late.
    listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    try:
        if sys.platform != "win32":  # on Windows it would let another program bind the same port
            listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.bind(("127.0.0.1", port))
        listening.listen(128)
    except (OSError, OverflowError) as error:
        listening.close()
        why = getattr(error, "strerror", None) or str(error)
        raise StudioError(f"cannot bind port {port} ({why}); leave out --port to get a free one") from None
    return listening
