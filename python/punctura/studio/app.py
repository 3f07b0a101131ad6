"""The studio's addresses; docs/studio-server.md describes them."""

import asyncio
import gzip
import os
import re
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager
from functools import lru_cache
from mimetypes import guess_type
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.datastructures import Headers
from starlette.requests import Request
from starlette.responses import FileResponse, HTMLResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import BaseRoute, Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.types import Scope
from starlette.websockets import WebSocket

from punctura import __version__
from punctura.exercise import exercise_json_schema
from punctura.scene import scene_json_schema
from punctura.studio.api import Api
from punctura.studio.catalog import ready_scenes
from punctura.studio.connections import Connections
from punctura.studio.health import limits_of
from punctura.studio.hub import Hub
from punctura.studio.live import serve_viewer
from punctura.studio.security import PROTOCOL, TOKEN_PART, WITH_TOKEN, Guard
from punctura.studio.session import Session
from punctura.studio.wire.messages import PROTOCOL as NUMBER
from punctura.studio.wire.messages import DevicePart, Hello

_TEXT = (".js", ".css", ".html", ".svg")


class PageFiles(StaticFiles):
    """The files of the page, compressed for a browser that takes it."""

    def file_response(
        self, full_path: str | os.PathLike[str], stat_result: os.stat_result, scope: Scope, status_code: int = 200
    ) -> Response:
        path = Path(full_path)
        taken = ",".join(Headers(scope=scope).getlist("accept-encoding")).split(",")
        if "gzip" not in {each.partition(";")[0].strip() for each in taken} or path.suffix not in _TEXT:
            return super().file_response(full_path, stat_result, scope, status_code)
        return Response(
            _compressed(path, stat_result.st_mtime_ns, stat_result.st_size),
            status_code,
            {"content-encoding": "gzip", "vary": "accept-encoding"},
            media_type=guess_type(path.name)[0],
        )


@lru_cache(maxsize=64)
def _compressed(path: Path, changed_ns: int, size: int) -> bytes:
    """Once for each version of a file: a stranger who asks again and again costs no more than a copy."""
    return gzip.compress(path.read_bytes(), 6, mtime=0)


_MADE = re.compile(r"index\.html|(fig\d\d|chatter|pop)\.(png|svg|csv)")


def likely_folders() -> list[Path]:
    """The default folders of `./run reproduce` and `punctura reproduce`, relative to the current folder."""
    try:
        here = Path.cwd()
    except OSError:  # it has been deleted
        return []
    return [here / "out", here / "out" / "reproduce"]


class Figures:
    """Looks at each request, because the page may be created while the studio runs."""

    def __init__(self, folders: Sequence[Path]) -> None:
        self._folders = list(folders)

    def route(self) -> Route:
        return Route("/figures/{name}", self.file)

    def index(self) -> Route:
        return Route("/figures/", self.file)

    @property
    def exist(self) -> bool:
        return self._find("index.html") is not None

    def file(self, request: Request) -> Response:
        file = self._find(request.path_params.get("name", "index.html"))
        if file:
            return FileResponse(file)
        return PlainTextResponse("There are no figures yet: punctura reproduce makes them.\n", 404)

    def _find(self, name: str) -> Path | None:
        for folder in self._folders if _MADE.fullmatch(name) else ():
            # The page is written last: when it is there, so are the other files.
            if all((folder / each).is_file() and not (folder / each).is_symlink() for each in ("index.html", name)):
                return folder / name
        return None


_ASSET = re.compile(r"(?<=\")\./assets/(?=[^\"?]+\")")
NO_PAGE = "The page has not been built: npm ci && npm run build in web/ does it."


class Studio:
    """The state that the routes share."""

    def __init__(self, session: Session, hub: Hub, page: Path, token: str, figures: Sequence[Path] = ()) -> None:
        self.session, self.hub, self.page, self.token, self.figures = session, hub, page, token, Figures(figures)

    def hello(self, viewer: int) -> Hello:
        info = self.session.bench.device.info
        return Hello(
            protocol=NUMBER,
            version=__version__,
            viewer=viewer,
            device=DevicePart(
                backend=info.backend,
                model=info.model,
                simulated=self.session.bench.simulated,
                has_orientation=info.has_orientation,
                max_force=self.session.run.loop.limits.max_force,
                rate=info.rate,
            ),
            second_device=self.session.bench.second_model,
            limits=limits_of(self.session.run),
            scenes=ready_scenes(),
            exercises=self.session.exercises.choices(),
            figures=self.figures.exist,
        )

    async def index(self, request: Request) -> Response:
        index = self.page / "index.html"
        if not index.is_file():
            return PlainTextResponse(NO_PAGE + "\n", 503)
        text = index.read_text(encoding="utf-8")
        # With the token they are not refused when requests without it are too many. It stands in the path, so that the
        # addresses by which these files load each other have it too.
        if request.scope[WITH_TOKEN]:
            text = _ASSET.sub(rf"\g<0>{TOKEN_PART}{self.token}/", text)
        return HTMLResponse(text)

    async def access(self, request: Request) -> Response:
        """The guard checks this as it checks the socket; here the browser shows the reason of a refusal."""
        return Response(status_code=204)

    async def schema(self, request: Request) -> Response:
        return JSONResponse(scene_json_schema())

    async def exercise_schema(self, request: Request) -> Response:
        return JSONResponse(exercise_json_schema())

    async def scene(self, request: Request) -> Response:
        text = self.session.run.loaded.text()
        headers = {"content-disposition": 'attachment; filename="scene.toml"'}
        return Response(text, media_type="application/toml; charset=utf-8", headers=headers)

    async def socket(self, socket: WebSocket) -> None:
        if PROTOCOL not in socket.scope.get("subprotocols", []):
            await socket.close(1002, f"The socket speaks {PROTOCOL}.")
            return
        await socket.accept(PROTOCOL)
        await serve_viewer(socket, self.hub, self.session, self.hello)

    def routes(self) -> list[BaseRoute]:
        routes: list[BaseRoute] = [
            Route("/", self.index),
            Route("/api/access", self.access),
            Route("/api/schema", self.schema),
            Route("/api/exercise-schema", self.exercise_schema),
            Route("/api/scene.toml", self.scene),
            *Api(self.session).routes(),
            WebSocketRoute("/ws", self.socket),
            self.figures.index(),
            self.figures.route(),
        ]
        if self.page.is_dir():
            assets = PageFiles(directory=self.page / "assets", check_dir=False)
            routes.append(Mount(f"/assets/{TOKEN_PART}{{token}}", assets))
            routes.append(Mount("/", PageFiles(directory=self.page)))
        return routes


def build_app(
    studio: Studio, port: int, token: str, connections: Connections, report: Callable[[Exception], object]
) -> Guard:
    """The application, behind its guard. report: gets what it did not foresee."""

    @asynccontextmanager
    async def life(app: Any) -> AsyncIterator[None]:
        studio.hub.attach(asyncio.get_running_loop())
        watch = asyncio.create_task(connections.watch())
        yield
        watch.cancel()

    return Guard(Starlette(routes=studio.routes(), lifespan=life), port, token, connections, report)
