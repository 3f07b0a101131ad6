"""Computations in processes of their own, and answers that are sent while they are made."""

import itertools
import os
import queue
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

from pydantic_core import to_json
from starlette.responses import Response, StreamingResponse
from starlette.types import Receive, Scope, Send

from punctura.compare.background import processor_s

# Python puts the present folder first on its path. There a user's file named numpy.py would run as code.
_START = (
    "import sys; sys.path[:] = filter(None, sys.path); "
    "from runpy import run_module; run_module({!r}, run_name='__main__', alter_sys=True)"
)
WAIT_S = 2.0
ENDS_S = 0.01  # between two looks whether a worker that has closed its output has ended
STARVED_S = 3.0  # after which a worker that had less than half of a processor says so
ALIVE_S = 0.25  # after which a client that has gone is noticed
LONGEST_S = 1800.0  # of one computation
NOTHING = b"\n"
TOO_LONG = "the computation was ended because it took more than {:g} minutes; {}"
MOST_WAITING = 8  # computations: each holds one of the threads that answer pages
clock = time.monotonic  # the tests use another
MOST_ERRORS = 4096  # bytes of the worker's last error messages


class LabError(ValueError):
    """A job that is not possible; the text says why and what to do."""


def worker(module: str) -> list[str]:
    """The command that runs a module in a Python that imports nothing from the present folder."""
    return [sys.executable, "-c", _START.format(module)]


class Line:
    """The computations of all pages: one runs, the others wait in the order in which they came."""

    def __init__(self) -> None:
        self._asked: deque[object] = deque()  # the one that runs is the first
        self._moved = threading.Condition()

    def in_turn(self, compute: Callable[[], Iterator[bytes]], waiting: Callable[[str], bytes]) -> Iterator[bytes]:
        """The lines of a computation when its turn comes. Closing the iterator leaves the line.

        waiting: the line for one that waits, from words for the page; an empty line comes after each further ALIVE_S.
        Raises LabError if too many wait.
        """
        me = object()
        with self._moved:
            if len(self._asked) > MOST_WAITING:
                raise LabError(f"{MOST_WAITING} computations wait already; try again when they are done, or cancel one")
            self._asked.append(me)
        try:
            announced = 0
            while ahead := self._ahead(me):
                yield NOTHING if ahead == announced else waiting(f"waiting: {ahead} computation(s) before this one")
                announced = ahead
            yield from compute()
        finally:
            with self._moved:
                self._asked.remove(me)
                self._moved.notify_all()

    def _ahead(self, me: object) -> int:
        """How many come before this one, at once if none does, otherwise after ALIVE_S or when the line moves."""
        with self._moved:
            before = self._asked.index(me)
            self._moved.wait_for(lambda: self._asked.index(me) < before or before == 0, ALIVE_S)
            return self._asked.index(me)


def lines_of(
    command: list[str],
    asked: bytes,
    failed: Callable[[str], bytes],
    advice: str,
    folder: Path | None = None,
    starved: bytes = NOTHING,
) -> Iterator[bytes]:
    """The lines of a worker that reads `asked` from standard input. Closing the iterator ends the worker.

    failed: the line for a worker that ended early, from the reason. advice: what to do if it takes too long. folder:
    where it works. starved: the line for one that gets no processor, beside other work. An empty line comes after
    ALIVE_S without another, so that a client that has gone is noticed. After LONGEST_S the worker is ended, unless a
    line comes: it may be the result, so the worker gets WAIT_S to end.
    """
    environment = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    with tempfile.TemporaryFile() as errors, tempfile.TemporaryFile() as given:
        given.write(asked)
        given.seek(0)
        ends_at = clock() + LONGEST_S
        worker = subprocess.Popen(
            command,
            stdin=given,
            stdout=subprocess.PIPE,
            stderr=errors,
            env=environment,
            cwd=folder,
            start_new_session=True,
        )
        assert worker.stdout
        lines: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        reader = threading.Thread(target=_read, args=(worker.stdout, lines), name="punctura-lab", daemon=True)
        reader.start()
        since, used = clock(), 0.0
        try:
            while line := _next(lines):
                quiet = line == NOTHING
                if clock() - since >= STARVED_S:
                    before, since, used = (since, used), clock(), processor_s(worker.pid)
                    if quiet and used - before[1] < (since - before[0]) / 2:
                        line = starved
                if quiet and _has_ended(worker):
                    _kill(worker)  # the children of a worker that has died keep its output open
                elif clock() > (ends_at if quiet else ends_at + WAIT_S):
                    yield failed(TOO_LONG.format(LONGEST_S / 60, advice))
                    return
                yield line
            while not _has_ended(worker):  # it has closed its output
                if clock() > ends_at + WAIT_S:
                    yield failed(TOO_LONG.format(LONGEST_S / 60, advice))
                    return
                time.sleep(ENDS_S)
            _kill(worker)
            if code := worker.wait():
                yield failed(_why(code, errors))
        finally:
            _kill(worker)
            reader.join()
            worker.stdout.close()
            worker.wait()


def _has_ended(worker: subprocess.Popen[bytes]) -> bool:
    """Whether the worker has ended. It is not waited for: until `wait`, no other process gets its number."""
    if hasattr(os, "waitid"):  # not with Python before 3.13 on macOS
        return os.waitid(os.P_PID, worker.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None
    return worker.poll() is not None


def _kill(worker: subprocess.Popen[bytes]) -> None:
    """Ends a worker and its children. Does nothing after `wait`: another process may have the number by then."""
    if worker.returncode is not None:
        return
    if os.name != "posix":
        worker.kill()
        return
    with suppress(ProcessLookupError, PermissionError):  # all have ended
        os.killpg(worker.pid, signal.SIGKILL)


def _read(output: IO[bytes], lines: queue.SimpleQueue[bytes]) -> None:
    for line in output:
        lines.put(line)
    lines.put(b"")


def _next(lines: queue.SimpleQueue[bytes]) -> bytes:
    try:
        return lines.get(timeout=ALIVE_S)
    except queue.Empty:
        return NOTHING


def _why(code: int, errors: IO[bytes]) -> str:
    """Why a worker ended without a result. code: its exit status."""
    errors.seek(max(0, errors.seek(0, os.SEEK_END) - MOST_ERRORS))
    lines = errors.read().decode("utf-8", "replace").strip().splitlines()[-5:]
    if code == -signal.SIGKILL or (
        lines and lines[-1].startswith(("MemoryError", "numpy._core._exceptions._ArrayMem"))
    ):
        return "the computation ended early; is there enough memory?"
    return (
        f"the computation ended early (status {code}); a defect, please report it: {'; '.join(lines) or 'no message'}"
    )


def json_of(answer: object) -> Response:
    """A model, or a list of models, of wire_schema.Answer."""
    return Response(to_json(answer), media_type="application/json")


class Download(StreamingResponse):
    """Sends bytes as they come. Releases its slot when the response ends, also if the connection ends first."""

    def __init__(self, pieces: Iterator[bytes], place: threading.BoundedSemaphore | None = None, **more: Any) -> None:
        """Produces the first piece at once, so that an error in the file shows before the response begins.

        place: a slot that the caller has acquired. It is released when the response ends or cannot begin.
        """
        self._pieces, self._place = pieces, place
        try:
            first = list(itertools.islice(pieces, 1))
        except BaseException:
            self._end()
            raise
        super().__init__(itertools.chain(first, pieces), **more)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            await super().__call__(scope, receive, send)
        finally:
            self._end()

    def _end(self) -> None:
        close = getattr(self._pieces, "close", None)
        if close:
            close()
        if self._place:
            self._place.release()
            self._place = None
