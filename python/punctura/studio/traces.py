"""Files of measured traces that a page sends: what they hold, and their identification, in a process of its own."""

import asyncio
import shutil
import tempfile
import unicodedata
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

from starlette.concurrency import run_in_threadpool
from starlette.datastructures import QueryParams
from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response

from punctura.files.names import TRACE_ENDINGS
from punctura.studio import limits
from punctura.studio.computing import Download, LabError, Line, lines_of, worker
from punctura.studio.names import LONGEST, BadName, safe_name
from punctura.studio.security import FILES
from punctura.studio.wire.identified import ErrorLine, StepLine, TraceJob

FILE, IDENTIFY = FILES
COMMAND = worker("punctura.studio.trace_worker")
ADVICE = "try a number of membranes instead of auto, or a part of the trace"
MOST_RECEIVED = 2  # files at a time, so that a slow page does not keep another one waiting
LONGEST_WORD = 200  # characters of a value


class Late(Exception):
    """The file did not arrive in time."""


class Traces:
    """Files of pages. `line` is shared with the other computations."""

    def __init__(self, line: Line) -> None:
        self._line = line
        self._receiving = asyncio.Semaphore(MOST_RECEIVED)

    async def file(self, request: Request) -> Response:
        """What a file holds: its columns, and what it does not state."""
        return await self._answer("look", request)

    async def identify(self, request: Request) -> Response:
        """The identification of a file as lines: the trace, steps, the fit, other models, the report."""
        return await self._answer("identify", request)

    async def _answer(self, task: Literal["look", "identify"], request: Request) -> Response:
        job = _job(task, request.query_params)
        async with self._receiving:
            folder = await _received(request, job.file)
        lines = _lines(job, folder, self._line)
        return await run_in_threadpool(lambda: Download(lines, media_type="application/x-ndjson"))


def _job(task: Literal["look", "identify"], asked: QueryParams) -> TraceJob:
    """Raises LabError."""
    if any(len(value) > LONGEST_WORD for _, value in asked.multi_items()):
        raise LabError(f"a value has at most {LONGEST_WORD} characters")
    return TraceJob(
        task=task,
        file=file_name(asked.get("name", "")),
        columns=_pairs(asked.getlist("column")),
        units=_pairs(asked.getlist("unit")),
        order=asked.get("order", "recorded"),
        diameter_mm=asked.get("diameter_mm", ""),
        tip_angle_deg=asked.get("tip_angle_deg", ""),
        membranes=asked.get("membranes", "auto"),
    )


def _pairs(words: list[str]) -> dict[str, str]:
    """{"depth": "z"} of ["depth=z"]. Raises LabError."""
    if any("=" not in word for word in words):
        raise LabError("column and unit are ROLE=VALUE, for example depth=mm")
    return {role: value for role, _, value in (word.partition("=") for word in words)}


def file_name(name: str) -> str:
    """The name as that of a file in one folder. An ending that tells a format stays; others become text."""
    kept = "".join("_" if c in '/\\:*?"<>|' or unicodedata.category(c)[0] == "C" else c for c in name)
    if Path(kept).suffix.lower() not in TRACE_ENDINGS:  # others could be code, such as .py
        kept = f"{kept.strip(' .') or 'trace'}.txt"
    try:
        return safe_name(kept[-LONGEST:].strip(" ."))
    except BadName:
        return f"trace{Path(kept).suffix.lower()}"


async def _received(request: Request, name: str) -> Path:
    """A new folder with the body as a file. Raises Late, LabError, TooLarge, OSError."""
    folder = Path(tempfile.mkdtemp(prefix="punctura-"))
    try:
        await asyncio.wait_for(_receive(request, folder / name), limits.FILE_S)
    except BaseException as error:
        shutil.rmtree(folder, ignore_errors=True)
        if isinstance(error, asyncio.TimeoutError):
            raise Late(f"the file did not arrive within {limits.FILE_S:g} s; send it again") from None
        raise
    return folder


async def _receive(request: Request, path: Path) -> None:
    """Writes the body to a file while it comes."""
    with path.open("wb") as file:
        try:
            async for piece in request.stream():
                await run_in_threadpool(file.write, piece)
        except ClientDisconnect:
            raise LabError("the file did not arrive whole") from None


def _lines(job: TraceJob, folder: Path, line: Line) -> Iterator[bytes]:
    """The worker's lines as they come, in turn; then the folder with the file is removed."""

    def failed(why: str) -> bytes:
        return ErrorLine(text=why[:1].upper() + why[1:]).model_dump_json().encode() + b"\n"

    try:
        yield from line.in_turn(
            lambda: lines_of(COMMAND, job.model_dump_json().encode(), failed, ADVICE, folder),
            lambda words: StepLine(words=words, share=None).model_dump_json().encode() + b"\n",
        )
    finally:
        shutil.rmtree(folder, ignore_errors=True)
