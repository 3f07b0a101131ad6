"""The studio as a person meets it: `punctura run` in a process of its own, its page in Chromium."""

from __future__ import annotations

import os
import queue
import re
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # for person.py

from playwright.sync_api import Browser, Page, Playwright, sync_playwright

FLAGS = [
    "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader", "--use-angle=swiftshader",
    "--ignore-gpu-blocklist",
]  # fmt: skip
ADDRESS = re.compile(r"http://127\.0\.0\.1:(\d+)/\?token=\S+")


@dataclass
class Studio:
    """A running studio; `address` has its token."""

    address: str
    port: int
    recordings: Path
    process: subprocess.Popen[str]

    def end(self) -> int:
        """As Ctrl-C does; the exit code."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        return self.process.wait(20)


def start_studio(folder: Path, *words: str, port: int = 0, token: str = "") -> Studio:
    """`punctura run`, once it has told its address."""
    command = [sys.executable, "-m", "punctura.cli", "run", *words, "--no-browser", "--device", "simulated"]
    command += ["--port", str(port), "--recordings", str(folder)]
    environment = {
        **os.environ,
        "HOME": str(folder),
        "XDG_DATA_HOME": str(folder / "data"),
        "PUNCTURA_STUDIO_TOKEN": token,
    }
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment, cwd=folder
    )
    lines: queue.Queue[str] = queue.Queue()
    errors: list[str] = []
    assert process.stdout is not None and process.stderr is not None
    out, err = process.stdout, process.stderr
    threading.Thread(target=lambda: [lines.put(line) for line in out], daemon=True).start()
    threading.Thread(target=lambda: errors.extend(err), daemon=True).start()
    while process.poll() is None:
        try:
            found = ADDRESS.search(lines.get(timeout=1))
        except queue.Empty:
            continue
        if found:
            return Studio(found[0], int(found[1]), folder, process)
    raise AssertionError(f"the studio ended with {process.returncode}: {''.join(errors)}")


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[Studio]:
    running = start_studio(tmp_path, "k06-fig10")
    yield running
    running.end()


def launch(playwright: Playwright) -> Browser:
    """The system's Chromium, without a window and without a graphics card."""
    found = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    assert found, "Chromium is missing: apt-get install chromium"
    return playwright.chromium.launch(executable_path=found, args=FLAGS)


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    with sync_playwright() as playwright:
        launched = launch(playwright)
        yield launched
        launched.close()


@pytest.fixture
def page(browser: Browser, studio: Studio) -> Iterator[Page]:
    """The studio's page, past its tour; every error of its script fails the test."""
    errors: list[str] = []
    context = browser.new_context(viewport={"width": 1440, "height": 900}, reduced_motion="reduce")
    opened = context.new_page()
    opened.on("pageerror", lambda error: errors.append(str(error)))
    opened.goto(studio.address, timeout=120_000)
    yield opened
    context.close()
    assert not errors, errors
