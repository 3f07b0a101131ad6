"""The laboratory: comparisons and variations, computed by a process of their own at low priority."""

import json
import re
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import QueryParams
from starlette.requests import Request
from starlette.responses import Response

from punctura.compare.comparison import On
from punctura.compare.motion import MOST_RUNS
from punctura.compare.worker import Job, LabFailure, LabProgress, Variation
from punctura.scene import scene_text
from punctura.studio.computing import Download, LabError, Line, json_of, lines_of, worker
from punctura.studio.session import Session
from punctura.studio.wire.common import Part

# Fields on which no curve of a comparison depends: the simulation has no thumb that presses the syringe.
_OF_THE_SYRINGE = re.compile(r"syringe\.|membrane\[\d+\]\.(outflow|behind)_")
COMMAND = worker("punctura.compare.worker")
CHUNK = 1 << 16
KEPT_SCENES = 32  # of the last variations, for their zip files
LONGEST_ID = 64


class SceneField(Part):
    """A field of the present scene that can be varied. SI."""

    path: str
    value: float
    unit: str


class Lab:
    """Comparisons and variations. `line` is shared with the other computations."""

    def __init__(self, session: Session, line: Line) -> None:
        self._session, self._shelf = session, session.shelf
        self._scenes: dict[str, str] = {}  # scene texts by the id of their variation, the oldest first
        self._line = line

    def fields(self, request: Request) -> Response:
        """The fields of the present scene that can be varied, with their present values, SI."""
        return json_of(
            [
                SceneField(path=one.path, value=one.value, unit=one.unit)
                for one in self._session.run.loaded.scene.fields()
                if not _OF_THE_SYRINGE.match(one.path)
            ]
        )

    def compare(self, request: Request) -> Response:
        """The comparison as JSON lines: first the progress, then the result or the error."""
        job = self._job(request.query_params)
        if job.variation:
            self._keep(request.query_params.get("id", ""), job.variation.scene)
        return Download(_lines(job, self._line), media_type="application/x-ndjson")

    async def bundle(self, request: Request) -> Response:
        """The zip file of the same comparison; with the same id, of the scene that was compared."""
        job = await run_in_threadpool(self._job, request.query_params)  # it reads files: a disk may be slow
        if job.variation and (name := request.query_params.get("id", "")):
            if name not in self._scenes:
                raise LabError("the studio no longer has the scene of this variation; simulate it again")
            same = job.variation.model_copy(update={"scene": self._scenes[name]})
            job = job.model_copy(update={"variation": same})
        pieces = await _begun(_zipped(job, self._line), request)
        headers = {"content-disposition": 'attachment; filename="punctura-comparison.zip"'}
        return Download(pieces, media_type="application/zip", headers=headers)

    def _keep(self, name: str, scene: str) -> None:
        if not name:
            return
        self._scenes.pop(name, None)
        self._scenes[name] = scene
        while len(self._scenes) > KEPT_SCENES:
            del self._scenes[next(iter(self._scenes))]

    def _job(self, asked: QueryParams) -> Job:
        """Raises LabError, BadName, Missing."""
        on: On = "time" if asked.get("on") == "time" else "depth"
        names = asked.getlist("run")
        if asked.get("on", on) != on:
            raise LabError("on is depth or time")
        if len(asked.get("id", "")) > LONGEST_ID:
            raise LabError(f"id has at most {LONGEST_ID} characters")
        if names and len(names) <= MOST_RUNS:
            return Job(on=on, recordings=[(name, str(self._shelf.find(name))) for name in names])
        if names or "path" not in asked:
            raise LabError(f"choose 1 to {MOST_RUNS} recordings, or a parameter to vary")
        first, last, count = _number(asked, "from"), _number(asked, "to"), _number(asked, "count")
        if not (1 <= count <= MOST_RUNS and count == int(count)):
            raise LabError(f"a variation has 1 to {MOST_RUNS} runs")
        motion = asked.get("motion", "")
        return Job(
            on=on,
            variation=Variation(
                scene=scene_text(self._session.run.loaded.scene),
                path=asked["path"],
                values=np.linspace(first, last, int(count)).tolist(),
                speed=_number(asked, "speed") if "speed" in asked else 5e-3,
                recording=str(self._shelf.find(motion)) if motion else "",
            ),
        )


def _number(asked: QueryParams, name: str) -> float:
    try:
        value = float(asked[name])
    except (KeyError, ValueError):
        raise LabError(f"{name} must be a number") from None
    if not np.isfinite(value):
        raise LabError(f"{name} must be a finite number")
    return value


def _lines(job: Job, line: Line) -> Iterator[bytes]:
    """The worker's lines as they come, in turn."""
    asked, failed = job.model_dump_json().encode(), lambda why: LabFailure(error=why).model_dump_json().encode() + b"\n"

    def waiting(words: str) -> bytes:
        return LabProgress(share=0.0, run=words).model_dump_json().encode() + b"\n"

    starved = waiting("waiting for the processor")
    return line.in_turn(
        lambda: lines_of(COMMAND, asked, failed, "try fewer runs, or a shorter recording", starved=starved), waiting
    )


def _zipped(job: Job, line: Line) -> Iterator[bytes]:
    """The zip file in pieces; empty ones while it is made."""
    with tempfile.TemporaryDirectory(prefix="punctura-") as folder:
        path = Path(folder) / "comparison.zip"
        last = b"{}"
        for answer in _lines(job.model_copy(update={"zip": str(path)}), line):
            last = answer if answer.strip() else last
            yield b""
        if error := json.loads(last).get("error"):
            raise LabError(error)
        with path.open("rb") as file:
            while chunk := file.read(CHUNK):
                yield chunk


async def _begun(pieces: Iterator[bytes], request: Request) -> Iterator[bytes]:
    """The pieces from the first one that is not empty. Raises what they raise, LabError if the client has gone."""
    while not (first := await run_in_threadpool(next, pieces, b"-")):
        if await request.is_disconnected():
            await run_in_threadpool(pieces.close)  # type: ignore[attr-defined]
            raise LabError("the computation was cancelled")

    def rest() -> Iterator[bytes]:
        yield first
        yield from pieces

    return rest()
