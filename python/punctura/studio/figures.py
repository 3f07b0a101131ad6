"""Serves the page of `punctura reproduce`, if it exists: the files of that page and no others."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, Response
from starlette.routing import Route

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
