"""Runs `punctura run` in its own process, for the page's tests and screenshots, soak tests and fuzzers."""

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
PATIENCE_S = 120.0  # wait for the address; long enough for a busy computer
PUNCTURA = (sys.executable, "-m", "punctura")
ADDRESS = re.compile(r"http://127\.0\.0\.1:(\d+)/\?token=\S+")


class StudioProcess:
    """A studio with the simulated device. `url` includes the token. Recordings and results go to `folder`."""

    program: Sequence[str] = PUNCTURA

    def __init__(
        self,
        folder: Path,
        scene: str = "k06-fig12",
        page: Path | None = None,
        port: int = 0,
        token: str = "",
        open_files: int = 0,
        more: Sequence[str] = (),
        verb: Sequence[str] = ("run",),
    ) -> None:
        """scene: may be empty. page: folder to serve in place of the studio's page. token: default: a new one.

        open_files: limit of the studio's open files, on POSIX; 0 for that of this process. more: further options.
        verb: another one that serves a page.
        """
        self.recordings = folder / "recordings"
        command = [*self.program, *verb, *([scene] if scene else [])]
        command += ["--no-browser", "--device", "simulated", "--port", str(port)]
        command += ["--recordings", str(self.recordings)] if verb == ("run",) else []
        command += ["--page", str(page)] if page else []
        command += more
        home = {"HOME": str(folder), "XDG_DATA_HOME": str(folder / "data"), "PUNCTURA_STUDIO_TOKEN": token}
        self._out, self._errors = (folder / "out.txt").open("w+"), (folder / "log.txt").open("w+")
        self._process = subprocess.Popen(
            command,
            stdout=self._out,
            stderr=self._errors,
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
        raise RuntimeError(f"the studio did not start: {self.log()}")

    def log(self) -> str:
        """Its output on standard error."""
        return _whole(self._errors)

    @property
    def running(self) -> bool:
        return self._process.poll() is None

    def memory_mb(self) -> float:
        """Resident memory, MB; NaN if the system does not report it."""
        return resident_mb(self._process.pid)

    def kill(self) -> None:
        """Ends the studio at once, as a power cut does."""
        self._process.kill()
        self._process.wait()

    def end(self) -> int:
        """Ends the studio like Ctrl-C. Returns the exit status."""
        if self.running:
            self._process.send_signal(signal.SIGINT if os.name == "posix" else signal.SIGTERM)
        return self._process.wait(120)

    def __enter__(self) -> StudioProcess:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.end()
        self._out.close()
        self._errors.close()


def _prepare(open_files: int) -> None:
    """Makes the process react to interrupts, even if a script started this one in the background."""
    import resource  # not on Windows

    signal.signal(signal.SIGINT, signal.SIG_DFL)
    if open_files:
        resource.setrlimit(resource.RLIMIT_NOFILE, (open_files, open_files))


def _whole(file: TextIO) -> str:
    return Path(file.name).read_text()


def blank_page(folder: Path) -> Path:
    """A minimal page that needs no build."""
    page = folder / "page"
    page.mkdir()
    (page / "index.html").write_text("<!doctype html><title>page</title>")
    return page


class Memory:
    """Memory samples of a run. The first share is warm-up."""

    def __init__(self, seconds: float, warm: float = 0.1) -> None:
        self._seconds = seconds
        self._from = time.monotonic() + warm * seconds
        self.samples: list[float] = []

    def add(self, megabytes: float) -> None:
        if time.monotonic() >= self._from:
            self.samples.append(megabytes)

    def flat(self, most: float) -> bool:
        """Whether memory has grown by at most this share. True for a short run, which is all warm-up."""
        return self._seconds < SHORT_S or not self.growth() > most  # NaN: this system does not report it

    def growth(self) -> float:
        """Growth from the first to the last tenth of the samples, by medians; NaN without samples."""
        n = max(1, len(self.samples) // 10)
        if not self.samples:
            return float("nan")
        return statistics.median(self.samples[-n:]) / statistics.median(self.samples[:n]) - 1
