"""Runs a studio for minutes with four viewers while it records every tick.

The viewers are the page in Chromium without a graphics card, two that only read, and one that never reads, which the
studio disconnects after a while.

    python tools/soak_studio.py --minutes 30

Passes if no tick is lost in the recording or at the reading viewers, if the server's memory and the page's heap grow by
less than 5 % after the warm-up (the first tenth of the run), and if a plot is drawn more than 10 times per second. (A
busy page draws each plot 15 times at most.)
"""

import argparse
import base64
import os
import socket
import statistics
import sys
import tempfile
import time
from pathlib import Path

from punctura.record import open_recording
from punctura.studio.client import StudioClient
from studio_process import SHORT_S, Memory, StudioProcess
from watched_page import WatchedPage

MOST_GROWTH = 0.05
LEAST_PLOTS = 10.0  # per second, with software rendering


def stalled_viewer(page: StudioClient) -> socket.socket:
    """Opens a page's WebSocket and never reads from it."""
    host, _, port = page.host.rpartition(":")
    raw = socket.create_connection((host, int(port)), 20)
    raw.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    key = base64.b64encode(os.urandom(16)).decode()
    raw.sendall(
        f"GET /ws HTTP/1.1\r\nHost: {page.host}\r\nOrigin: http://{page.host}\r\nUpgrade: websocket\r\n"
        f"Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n"
        f"Sec-WebSocket-Protocol: punctura.v1, token.{page.token}\r\n\r\n".encode()
    )
    return raw


class Watched:
    """Statistics of the browser's viewer, minute by minute."""

    def __init__(self, seconds: float) -> None:
        self.seconds = seconds
        self.heap = Memory(seconds)
        self.rates: list[dict[str, float]] = []

    def look(self, page: WatchedPage) -> str:
        rates, heap = page.rates(), page.heap_mb()
        page.rates()  # do not count the time of the garbage collection
        self.rates.append(rates)
        self.heap.add(heap)
        frames = ", ".join(f"{name} {rate:.1f}" for name, rate in rates.items())
        return f"browser: {frames} a second, heap {heap:.1f} MB"

    def fluent(self) -> bool:
        """Whether a plot was drawn often enough. True for a short run, which cannot judge it."""
        return self.seconds < SHORT_S or self.median("plots") > LEAST_PLOTS

    def median(self, name: str) -> float:
        return statistics.median(rates[name] for rates in self.rates) if self.rates else float("nan")


def soak(seconds: float, folder: Path, picture: Path | None) -> int:
    memory, watched = Memory(seconds), Watched(seconds)
    every = min(60.0, seconds / 4)
    with StudioProcess(folder) as studio:
        pages = [StudioClient(studio.url, patience=600) for _ in range(2)]
        holder = pages[0]
        stalled = stalled_viewer(holder)
        holder.wait(lambda: holder.last)
        with WatchedPage(studio.url) as browser:
            answer = holder.ask(do="start_recording", name="soak")
            holder.ask(do="strokes", period=4.0)
            browser.rates()
            shown = began = time.monotonic()
            while (now := time.monotonic()) - began < seconds and studio.running:
                browser.pause(0.5)
                memory.add(studio.memory_mb())
                for page in pages:
                    del page.messages[:-100]  # limits the memory of this program
                if now - shown > every:
                    shown = now
                    ticks = [page.ticks for page in pages]
                    print(
                        f"{now - began:.0f} s: {studio.memory_mb():.1f} MB, {ticks} ticks; {watched.look(browser)}",
                        flush=True,
                    )
            status = holder.status()
            if picture:
                browser.picture(picture)
            errors = browser.errors
        asked = time.monotonic()
        stopped = holder.ask(do="stop_recording")
        finished_s = time.monotonic() - asked
        stalled.close()
        for page in pages:
            page.close()
        code = studio.end()
        recording = open_recording(folder / "recordings" / "soak.parquet")
        gaps, log = sum(page.gaps for page in pages), studio.log()
    print(
        f"{status['viewers']} viewers; {recording.rows} ticks recorded, {recording.lost} lost; gaps at viewers: {gaps}"
    )
    print(f"late {status['late']}, not shown {status['lost']}; exit status of the studio: {code}")
    print(f"the recording was finished in {finished_s:.1f} s")
    largest = max(memory.samples, default=float("nan"))
    print(
        f"memory: {memory.samples[0] if memory.samples else 0:.1f} MB, at most {largest:.1f} MB, "
        f"grown by {memory.growth():+.1%}"
    )
    print(
        f"browser: heap grown by {watched.heap.growth():+.1%}; per second, median over the minutes: "
        f"{watched.median('plots'):.1f} plots, {watched.median('view'):.1f} frames of the 3-D view"
    )
    good = answer["ok"] and stopped["ok"] and recording.finished and status["viewers"] in (3, 4) and code == 130
    good = good and memory.flat(MOST_GROWTH) and watched.heap.flat(MOST_GROWTH) and not errors
    good = good and watched.fluent()
    good = good and recording.lost == 0 and gaps == 0 and status["lost"] == 0 and "Traceback" not in log
    print("passed" if good else f"FAILED {errors} {log[-2000:]}")
    return 0 if good else 1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--picture", type=Path, help="write a PNG of the page at the end")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        return soak(60 * options.minutes, Path(folder), options.picture)


if __name__ == "__main__":
    sys.exit(main())
