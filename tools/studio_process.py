"""`punctura run` in a process of its own, with a page that is only a word, for soak_studio.py and fuzz_studio.py."""

from __future__ import annotations

import os
import re
import signal
import statistics
import subprocess
import sys
import time
from pathlib import Path
from types import TracebackType

from resident import resident_mb

SHORT_S = 120.0
ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/\?token=\S+")


class StudioProcess:
    """A studio on the simulated device; `url` has its token. Its memory is read from /proc."""

    def __init__(self, folder: Path, scene: str = "k06-fig12") -> None:
        self.folder = folder
        page = folder / "page"
        page.mkdir()
        (page / "index.html").write_text("<!doctype html><title>page</title>")
        command = [sys.executable, "-m", "punctura.cli", "run", scene, "--no-browser", "--device", "simulated"]
        command += ["--page", str(page), "--recordings", str(folder / "recordings")]
        self._said = (folder / "said.txt").open("w+")
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=self._said, text=True)
        assert self._process.stdout is not None
        found = ADDRESS.search(self._process.stdout.readline())
        if not found:
            raise RuntimeError(f"the studio did not start: {self.said()}")
        self.url = found[0]

    def said(self) -> str:
        """On standard error."""
        self._said.seek(0)
        return self._said.read()

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
        self._said.close()


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
