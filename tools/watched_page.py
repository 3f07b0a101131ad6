"""Measures frame rates and script memory of the studio's page in Chromium without a graphics card."""

from __future__ import annotations

import time
from pathlib import Path
from types import TracebackType

from chromium import launch, on_the_bench
from playwright.sync_api import sync_playwright

PATIENCE_MS = 120_000  # long enough for a busy computer

# Counts the draw calls, so that a frame without new content does not count.
COUNT = """
window.drawn = { frames: 0, plots: 0, view: 0, curve: 0 };
const frame = () => { window.drawn.frames++; requestAnimationFrame(frame); };
requestAnimationFrame(frame);
const wipe = CanvasRenderingContext2D.prototype.clearRect;
let plot;
CanvasRenderingContext2D.prototype.clearRect = function (...of) {
  if (this.canvas.className === 'plot-canvas') {
    plot ??= this.canvas;
    if (this.canvas === plot) window.drawn.plots++;
  }
  return wipe.apply(this, of);
};
let curveAt = -1;
const line = CanvasRenderingContext2D.prototype.stroke;
CanvasRenderingContext2D.prototype.stroke = function (...of) {
  if (this.canvas.parentElement?.className === 'stage-curve' && curveAt !== window.drawn.frames) {
    curveAt = window.drawn.frames;
    window.drawn.curve++;
  }
  return line.apply(this, of);
};
const clear = WebGL2RenderingContext.prototype.clear;
WebGL2RenderingContext.prototype.clear = function (...of) { window.drawn.view++; return clear.apply(this, of); };
"""


class WatchedPage:
    """A viewer at `url`, at the bench or the stage.

    `rates` counts since its last call; `heap_mb` is measured after garbage collection.
    """

    def __init__(self, url: str, width: int = 1440, height: int = 900, bench: bool = True) -> None:
        self.errors: list[str] = []
        self._playwright = sync_playwright().start()
        self._browser = launch(self._playwright)
        self._page = self._browser.new_page(viewport={"width": width, "height": height})
        self._page.set_default_timeout(PATIENCE_MS)
        self._page.on("pageerror", lambda error: self.errors.append(str(error)))
        self._page.add_init_script(COUNT)
        if bench:
            on_the_bench(self._page.context)
        self._page.context.add_cookies([{"name": "punctura_tour", "value": "seen", "url": url}])
        self._page.goto(url)
        self._page.wait_for_function(f"() => window.drawn.{'plots' if bench else 'curve'} > 0")
        self._tools = self._page.context.new_cdp_session(self._page)
        self._before, self._at = self._drawn(), time.monotonic()

    def _drawn(self) -> dict[str, int]:
        counts: dict[str, int] = self._page.evaluate("({...window.drawn})")
        return counts

    def rates(self) -> dict[str, float]:
        """Frames per second of the browser, the first plot, the 3-D view and the stage's curve."""
        now, drawn = time.monotonic(), self._drawn()
        rates = {name: (drawn[name] - self._before[name]) / (now - self._at) for name in drawn}
        self._before, self._at = drawn, now
        return rates

    def processor_seconds(self) -> dict[str, float]:
        """Processor time of the browser's processes so far, by kind: renderer, GPU (which draws), and others."""
        tools = self._browser.new_browser_cdp_session()
        used: dict[str, float] = {}
        for process in tools.send("SystemInfo.getProcessInfo")["processInfo"]:
            used[process["type"]] = used.get(process["type"], 0.0) + process["cpuTime"]
        tools.detach()
        return used

    def text(self, selector: str) -> str:
        """The text of an element of the page, which may be hidden."""
        return self._page.locator(selector).text_content() or ""

    def heap_mb(self) -> float:
        self._tools.send("HeapProfiler.collectGarbage")
        return float(self._tools.send("Runtime.getHeapUsage")["usedSize"]) / 1e6

    def picture(self, path: Path) -> None:
        self._page.screenshot(path=str(path))

    def pause(self, seconds: float) -> None:
        """Waits, and handles the browser's messages meanwhile."""
        self._page.wait_for_timeout(1e3 * seconds)

    def __enter__(self) -> WatchedPage:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._browser.close()
        self._playwright.stop()
