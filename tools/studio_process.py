"""`punctura run` in a process of its own: for the page's tests and pictures, for soaks and fuzzers."""

from __future__ import annotations

import os
import re
import signal
import statistics
import subprocess
import sys
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import TextIO

from resident import resident_mb
from waiting import wait_until

SHORT_S = 120.0
PATIENCE_S = 120.0  # for the address, on a busy computer
ADDRESS = re.compile(r"http://127\.0\.0\.1:(\d+)/\?token=\S+")


class StudioProcess:
    """A studio on the simulated device; `url` has its token. Its recordings and results stay in `folder`."""

    def __init__(
        self,
        folder: Path,
        scene: str = "k06-fig12",
        page: Path | None = None,
        port: int = 0,
        token: str = "",
        open_files: int = 0,
        terminal: int | None = None,
        more: Sequence[str] = (),
    ) -> None:
        """page: a folder to serve in place of the studio's own page. token: given, or one of its own.

        open_files: how many the studio may have, on POSIX; 0: as many as this process. terminal: the descriptor that is
        its standard error, of which `said` then knows nothing. more: options of `punctura run`.
        """
        self.recordings = folder / "recordings"
        command = [sys.executable, "-m", "punctura.cli", "run", scene, "--no-browser", "--device", "simulated"]
        command += ["--port", str(port), "--recordings", str(self.recordings)] + (["--page", str(page)] if page else [])
        command += more
        home = {"HOME": str(folder), "XDG_DATA_HOME": str(folder / "data"), "PUNCTURA_STUDIO_TOKEN": token}
        self._out, self._errors = (folder / "out.txt").open("w+"), (folder / "said.txt").open("w+")
        self._process = subprocess.Popen(
            command,
            stdout=self._out,
            stderr=self._errors if terminal is None else terminal,
            env={**os.environ, **home},
            cwd=folder,
            preexec_fn=(lambda: _prepare(open_files)) if os.name == "posix" else None,
        )
        self.url, self.port = self._address()

    def _address(self) -> tuple[str, int]:
        with suppress(TimeoutError):
            wait_until(lambda: ADDRESS.search(_whole(self._out)) or not self.running, PATIENCE_S, poll=0.02)
        if found := ADDRESS.search(_whole(self._out)):
            return found[0], int(found[1])
        self.end()
        raise RuntimeError(f"the studio did not start: {self.said()}")

    def said(self) -> str:
        """On standard error."""
        return _whole(self._errors)

    @property
    def running(self) -> bool:
        return self._process.poll() is None

    def memory_mb(self) -> float:
        """Resident; NaN where the system does not tell."""
        return resident_mb(self._process.pid)

    def end(self) -> int:
        """As Ctrl-C does; the exit code."""
        if self.running:
            self._process.send_signal(signal.SIGINT if os.name == "posix" else signal.SIGTERM)
        return self._process.wait(600)

    def __enter__(self) -> StudioProcess:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.end()
        self._out.close()
        self._errors.close()


def _prepare(open_files: int) -> None:
    """Heeds interrupts as in a terminal, also where a script has started this one in the background."""
    import resource  # not on Windows

    signal.signal(signal.SIGINT, signal.SIG_DFL)
    if open_files:
        resource.setrlimit(resource.RLIMIT_NOFILE, (open_files, open_files))


def _whole(file: TextIO) -> str:
    return Path(file.name).read_text()


def blank_page(folder: Path) -> Path:
    """A page that is only a word: nothing has to be built for it."""
    page = folder / "page"
    page.mkdir()
    (page / "index.html").write_text("<!doctype html><title>page</title>")
    return page


class Memory:
    """Samples over a run, of which the first share is warming up."""

    def __init__(self, seconds: float, warm: float = 0.1) -> None:
        self._seconds = seconds
        self._from = time.monotonic() + warm * seconds
        self.samples: list[float] = []

    def add(self, megabytes: float) -> None:
        if time.monotonic() >= self._from:
            self.samples.append(megabytes)

    def flat(self, most: float) -> bool:
        """Whether it has grown by no more than this share. A short run is all warming up, and says nothing."""
        return self._seconds < SHORT_S or not self.growth() > most  # NaN: this system does not tell

    def growth(self) -> float:
        """From the first tenth of the samples to the last, by their medians; NaN without samples."""
        n = max(1, len(self.samples) // 10)
        if not self.samples:
            return float("nan")
        return statistics.median(self.samples[-n:]) / statistics.median(self.samples[:n]) - 1
