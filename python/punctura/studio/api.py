"""The addresses under /api for recordings, exercises and results. docs/studio-server.md has the table.

Each request runs in a thread of the server's pool, so that a long file blocks neither a page nor the worker.
"""

import math
import threading
from collections.abc import Awaitable, Callable
from pathlib import Path
from urllib.parse import quote

from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, Response
from starlette.routing import Route

from punctura.defects import explain
from punctura.exercise import Result, ResultsError
from punctura.exercise.results import to_csv, to_json
from punctura.exercise.xapi import to_xapi
from punctura.extras import MissingPackageError
from punctura.record import RecordingError, open_recording
from punctura.record.save_as import export_pieces
from punctura.studio.catalog import DRAFT, scene_outlines
from punctura.studio.computing import Download, LabError, Line, json_of
from punctura.studio.lab import Lab
from punctura.studio.limits import MOST_EXPORTS
from punctura.studio.names import BadName, safe_name
from punctura.studio.recorded import FEWEST, MOST, USUAL, overview, thinned_trace, tick_frames
from punctura.studio.security import TooLarge
from punctura.studio.session import SITTING_RUNS, Session
from punctura.studio.shelf import SUFFIX, Busy, Missing
from punctura.studio.traces import FILE, IDENTIFY, Late, Traces

FORMATS = {"parquet": "application/vnd.apache.parquet", "csv": "text/csv; charset=utf-8", "mcap": "application/x-mcap"}
# By format: the media type, the ending of the file, and the function that writes it.
RESULT_FORMATS: dict[str, tuple[str, str, Callable[[list[Result]], str]]] = {
    "json": ("application/json", "json", to_json),
    "csv": ("text/csv; charset=utf-8", "csv", to_csv),
    "xapi": ("application/x-ndjson; charset=utf-8", "xapi.jsonl", to_xapi),
}
_STATUS: dict[type[Exception], int] = {
    BadName: 400,
    LabError: 422,
    Late: 408,
    TooLarge: 413,
    Missing: 404,
    Busy: 409,
    ResultsError: 404,
    RecordingError: 422,
    Exception: 500,
}


class Api:
    """Holds what the routes need."""

    def __init__(self, session: Session) -> None:
        self._session, self._shelf, self._results = session, session.shelf, session.results
        self._exporting = threading.BoundedSemaphore(MOST_EXPORTS)
        line = Line()
        self._lab, self._traces = Lab(session, line), Traces(line)

    def routes(self) -> list[Route]:
        one = "/api/recordings/{name}"
        return [
            Route("/api/recordings", self._with_status(self.recordings)),
            Route(one, self._with_status(self.recording), methods=["GET"]),
            Route(one, self._with_status(self.delete), methods=["DELETE"]),
            Route(one + "/ticks", self._with_status(self.ticks)),
            Route(one + "/trace", self._with_status(self.trace)),
            Route(one + "/download", self._with_status(self.download)),
            Route("/api/fault.csv", self._with_status(self.fault_ticks)),
            Route("/api/lab/fields", self._with_status(self._lab.fields)),
            Route("/api/lab/compare", self._with_status(self._lab.compare)),
            Route("/api/lab/bundle", self._with_status_async(self._lab.bundle)),
            Route(FILE, self._with_status_async(self._traces.file), methods=["POST"]),
            Route(IDENTIFY, self._with_status_async(self._traces.identify), methods=["POST"]),
            Route("/api/exercises", self._with_status(self.exercises)),
            Route("/api/scenes", self._with_status(self.scenes)),
            Route("/api/results", self._with_status(self.results)),
            Route(
                "/api/results/download", self._with_status(self.download_results)
            ),  # before NAME: no result has this name
            Route("/api/results/{name}", self._with_status(self.result), methods=["GET"]),
            Route("/api/results/{name}", self._with_status(self.delete_result), methods=["DELETE"]),
            Route("/api/results/{name}/download", self._with_status(self.download_result)),
        ]

    def _with_status(self, endpoint: Callable[[Request], Response]) -> Callable[[Request], Response]:
        """Errors become an HTTP status and a sentence."""

        def answer(request: Request) -> Response:
            try:
                self._check_free()
                return endpoint(request)
            except Exception as error:
                return _refusal(error)

        return answer

    def _with_status_async(
        self, endpoint: Callable[[Request], Awaitable[Response]]
    ) -> Callable[[Request], Awaitable[Response]]:
        """The same for an endpoint that takes the request's body while it comes."""

        async def answer(request: Request) -> Response:
            try:
                self._check_free()
                return await endpoint(request)
            except Exception as error:
                return _refusal(error)

        return answer

    def _check_free(self) -> None:
        if self._session.sitting:  # its recordings must stay, and its ticks need the processor
            raise Busy(SITTING_RUNS)

    def recordings(self, request: Request) -> Response:
        return json_of(self._shelf.entries(exclude=self._session.recording))

    def recording(self, request: Request) -> Response:
        return json_of(self._shelf.read(_name(request), lambda path: overview(open_recording(path))))

    def ticks(self, request: Request) -> Response:
        return self._shelf.read(_name(request), _ticks_of)

    def trace(self, request: Request) -> Response:
        asked = request.query_params
        try:
            start, points = float(asked.get("from", "0")), int(asked.get("points", str(USUAL)))
            before = int(asked["before"]) if "before" in asked else None
        except ValueError:
            start, points, before = math.nan, 0, None
        if not (math.isfinite(start) and FEWEST <= points <= MOST and (before is None or before >= 0)):
            return _sentence(
                400,
                f"from is a time in s, points a number from {FEWEST} to {MOST}, before a membrane's index.",
            )
        return json_of(
            self._shelf.read(_name(request), lambda path: thinned_trace(open_recording(path), start, points, before))
        )

    def delete(self, request: Request) -> Response:
        self._shelf.delete(_name(request), self._session.recording)
        return Response(status_code=204)

    def download(self, request: Request) -> Response:
        name, kind = safe_name(_name(request)), request.query_params.get("format", "parquet")
        if kind not in FORMATS:
            return _sentence(400, f"There is {', '.join(FORMATS)}.")
        return self._shelf.read(name, lambda path: self._file(path, name, kind))

    def _file(self, path: Path, name: str, kind: str) -> Response:
        if kind == "parquet" and path.suffix == SUFFIX:
            return FileResponse(path, media_type=FORMATS[kind], filename=path.name)
        if not self._exporting.acquire(blocking=False):
            return _sentence(503, f"{MOST_EXPORTS} other files are being downloaded; try again when one is done.")
        try:
            headers = {"content-disposition": disposition(f"{name}.{kind}")}
            pieces = export_pieces(open_recording(path), kind)
        except BaseException:
            self._exporting.release()
            raise
        try:
            return Download(pieces, self._exporting, media_type=FORMATS[kind], headers=headers)
        except MissingPackageError as missing:
            return _sentence(501, f"{missing}.")

    def fault_ticks(self, request: Request) -> Response:
        file = self._session.kept_ticks.csv()
        if file is None:
            return _sentence(404, "There was no fault.")
        name, data = file
        return Response(data, media_type=FORMATS["csv"], headers={"content-disposition": disposition(name)})

    def exercises(self, request: Request) -> Response:
        experts = {name: run for name, run in self._session.experts.all().items() if self._shelf.has(run)}
        run = self._session.run
        entries = self._session.exercises.overviews(run.loop.limits, run.thumb.limits if run.thumb else None)
        return json_of([entry.model_copy(update={"expert": experts.get(entry.name, "")}) for entry in entries])

    def scenes(self, request: Request) -> Response:
        return json_of(scene_outlines())

    def results(self, request: Request) -> Response:
        return json_of(self._results.all(*_of_whom(request)))

    def result(self, request: Request) -> Response:
        return json_of(self._result(_name(request)))

    def _result(self, name: str) -> Result:
        return (name == DRAFT and self._session.exercises.drafts.last) or self._results.load(name)

    def delete_result(self, request: Request) -> Response:
        self._results.delete(_name(request))
        return Response(status_code=204)

    def download_result(self, request: Request) -> Response:
        result = self._result(_name(request))
        return self._written([result], result.name, request)

    def download_results(self, request: Request) -> Response:
        return self._written(self._results.all(*_of_whom(request)), "results", request)

    def _written(self, results: list[Result], name: str, request: Request) -> Response:
        kind = request.query_params.get("format", "json")
        if kind not in RESULT_FORMATS:
            return _sentence(400, f"There is {', '.join(RESULT_FORMATS)}.")
        media, ending, write = RESULT_FORMATS[kind]
        headers = {"content-disposition": f'attachment; filename="{name}.{ending}"'}
        return Response(write(results), media_type=media, headers=headers)


def disposition(filename: str) -> str:
    """The header that makes a browser download the response under this name; any characters are allowed."""
    return f"attachment; filename*=utf-8''{quote(filename, safe='')}"


def _name(request: Request) -> str:
    name: str = request.path_params["name"]
    return name


def _of_whom(request: Request) -> tuple[str | None, str | None]:
    """The person and the class that a request asks for; None: any."""
    return request.query_params.get("person"), request.query_params.get("group")


def _sentence(status: int, text: str) -> Response:
    return PlainTextResponse(text + "\n", status)


def _ticks_of(path: Path) -> Response:
    return Download(tick_frames(open_recording(path)), media_type="application/octet-stream")


def _refusal(error: Exception) -> Response:
    status = next(code for kind, code in _STATUS.items() if isinstance(error, kind))
    text = explain(error)
    return _sentence(status, text[:1].upper() + text[1:] + ("" if text.endswith(".") else "."))
