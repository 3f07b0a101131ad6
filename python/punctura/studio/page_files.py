"""The files of the page, compressed for a browser that takes it."""

import gzip
import os
from functools import lru_cache
from mimetypes import guess_type
from pathlib import Path

from starlette.datastructures import Headers
from starlette.responses import Response
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

_TEXT = (".js", ".css", ".html", ".svg")


class PageFiles(StaticFiles):
    def file_response(
        self,
        full_path: str | os.PathLike[str],
        stat_result: os.stat_result,
        scope: Scope,
        status_code: int = 200,
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
