"""Measures how old the newest tick of a slow page is.

    python tools/tick_age.py [--slower 6] [--scene epidural] [--seconds 30] [--warm 10]

Chromium gives the page's thread so many times less of the processor. Meanwhile the simulated hand moves without a rest,
and a program reads the same ticks at once. Prints by how much the page is behind this program, ms: when it has taken a
message with ticks, and when it draws the view. A tick waits for up to 17 ms in the studio until it is sent at all.
"""

import argparse
import statistics
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from chromium import launch, on_the_bench
from playwright.sync_api import sync_playwright
from punctura import load_scene
from punctura.studio.client import StudioClient
from punctura.studio.wire.frames import Frame
from studio_process import StudioProcess
from view_rate import Hand

SIZE = {"width": 1440, "height": 900}
NOTE = """
window.taken = [];
window.drawn = [];
let newest = -1;
const now = () => (performance.timeOrigin + performance.now()) / 1e3;
const endOf = (view, at) => Number(view.getBigUint64(at + 16, true)) + view.getUint32(at + 4, true);
const lastOf = (data) => {
  const view = new DataView(data);
  if (view.getUint32(0, true) !== 0x53544e50) return endOf(view, 0);
  let end = -1;
  for (let at = 4; at < data.byteLength; ) {
    const size = view.getUint32(at, true);
    end = endOf(view, at + 4);
    at += 4 + Math.ceil(size / 4) * 4;
  }
  return end;
};
window.WebSocket = class extends WebSocket {
  set onmessage(take) {
    this.addEventListener("message", (event) => {
      take(event);
      if (typeof event.data === "string") return;
      newest = lastOf(event.data);
      window.taken.push([now(), newest]);
    });
  }
};
const clear = WebGL2RenderingContext.prototype.clear;
WebGL2RenderingContext.prototype.clear = function (...of) {
  window.drawn.push([now(), newest]);
  return clear.apply(this, of);
};
"""


class Reader(StudioClient):
    """Notes when it has each tick: its number and the time."""

    def __init__(self, url: str) -> None:
        self.seen: list[tuple[int, float]] = []
        super().__init__(url)

    def _take(self, frame: Frame) -> None:
        super()._take(frame)
        self.seen.append((frame.first_tick + len(frame), time.time()))


def report(what: str, page: list[list[float]], seen: list[tuple[int, float]]) -> None:
    ticks, times = np.array(seen).T
    at, newest = np.array(page).T
    behind = 1e3 * (at - np.interp(newest, ticks, times))
    middle, most = statistics.median(behind), np.percentile(behind, 95)
    rate = len(page) / (at[-1] - at[0])
    print(
        f"{what}: {middle:.0f} ms behind (median), {most:.0f} ms (95 %), {max(behind):.0f} ms at most; {rate:.1f} a s"
    )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--slower", type=float, default=6.0)
    parser.add_argument("--scene", default="epidural")
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--warm", type=float, default=10.0, help="seconds before the measurement")
    parser.add_argument("--bench", action="store_true")
    arguments = parser.parse_args()
    with (
        tempfile.TemporaryDirectory() as folder,
        StudioProcess(Path(folder), arguments.scene) as studio,
        Reader(studio.url) as client,  # connects before the page, and so has control
        sync_playwright() as playwright,
    ):
        client.wait(lambda: client.of("scene"))
        browser = launch(playwright)
        page = browser.new_page(viewport=SIZE)
        page.add_init_script(NOTE)
        if arguments.bench:
            on_the_bench(page.context)
        with Hand(client, load_scene(arguments.scene)):
            page.goto(studio.url)
            page.wait_for_function("() => window.drawn.length > 0", timeout=120_000)
            page.context.new_cdp_session(page).send("Emulation.setCPUThrottlingRate", {"rate": arguments.slower})
            page.wait_for_timeout(1e3 * arguments.warm)
            page.evaluate("taken.length = drawn.length = 0")
            page.wait_for_timeout(1e3 * arguments.seconds)
            taken, drawn = page.evaluate("[taken, drawn]")
        report("ticks taken", taken, client.seen)
        report("view drawn", drawn, client.seen)
        browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
