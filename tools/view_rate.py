"""Measures how fast the 3-D view is drawn in Chromium without a graphics card.

    python tools/view_rate.py [--scene epidural] [--seconds 30] [--size 1440x900] [--warm 22] [--page FOLDER] [--stage]
                               [--rest]

The simulated hand goes in and out through all membranes without a rest: at rest the view draws only what fades, 4
times a second. With --rest nothing moves it. Prints the pictures per second of the view, of a plot, of the stage's
curve and of the browser (medians of 2 s), the sharpness that the view chose, and the processor time of Chromium's
processes, in all and per picture. Nothing else should run on the computer, except for the processor times, which hardly
depend on it.
"""

from __future__ import annotations

import argparse
import math
import statistics
import sys
import tempfile
import threading
import time
from contextlib import nullcontext
from pathlib import Path

import numpy as np
from punctura import Scene, load_scene
from punctura.live import stroke_ends
from punctura.studio.client import StudioClient
from studio_process import StudioProcess
from watched_page import WatchedPage

WARM_S = 22.0  # sheets are painted, the compiler of the page's script has run, the plots' 20 s are full
EACH_S = 2.0
PERIOD_S = 6.0  # of the hand, in and out
STEP_S = 1 / 60  # between two targets of the hand


class Hand(threading.Thread):
    """Moves the simulated hand like a sine until it is stopped."""

    def __init__(self, client: StudioClient, scene: Scene) -> None:
        super().__init__(daemon=True)
        self._client, self._ended = client, threading.Event()
        self._ends = [np.array(end) for end in stroke_ends(scene)]
        self._axis = list(scene.membranes[0].inward_normal)

    def run(self) -> None:
        start, end = self._ends
        began = time.monotonic()
        while not self._ended.wait(STEP_S):
            share = 0.5 - 0.5 * math.cos(2 * math.pi * (time.monotonic() - began) / PERIOD_S)
            self._client.target((start + share * (end - start)).tolist(), self._axis)

    def __enter__(self) -> Hand:
        self.start()
        return self

    def __exit__(self, *reason: object) -> None:
        self._ended.set()
        self.join()


def measure(page: WatchedPage, seconds: float, warm: float) -> None:
    page.pause(warm)
    page.rates()
    before, samples, began = page.processor_seconds(), [], time.monotonic()
    for _ in range(max(1, round(seconds / EACH_S))):
        page.pause(EACH_S)
        samples.append(page.rates())
    after, passed = page.processor_seconds(), time.monotonic() - began
    for name in samples[0]:
        rates = sorted(sample[name] for sample in samples)
        print(f"{name:8} {statistics.median(rates):5.1f} a second, from {rates[0]:.1f} to {rates[-1]:.1f}")
    pictures = sum(sample["view"] for sample in samples) * EACH_S
    for kind in sorted(after):
        used = after[kind] - before.get(kind, 0.0)
        each = f", {1e3 * used / pictures:.1f} ms per picture" if pictures else ""
        print(f"{kind:8} {used:5.1f} s of processor time, {100 * used / passed:.1f} % of a core{each}")
    print(f"sharpness: {page.text('.view-coarser') or 'full'}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", default="epidural")
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--size", default="1440x900")
    parser.add_argument("--warm", type=float, default=WARM_S, help="seconds before the measurement")
    parser.add_argument("--page", type=Path, help="folder of another build of the page")
    parser.add_argument("--stage", action="store_true", help="the stage, and not the bench")
    parser.add_argument("--rest", action="store_true", help="nothing moves the needle")
    arguments = parser.parse_args()
    width, height = (int(part) for part in arguments.size.split("x"))
    with (
        tempfile.TemporaryDirectory() as folder,
        StudioProcess(Path(folder), arguments.scene, page=arguments.page and arguments.page.resolve()) as studio,
        StudioClient(studio.url) as client,  # connects before the page, and so has control
    ):
        client.wait(lambda: client.of("scene"))
        with (
            nullcontext() if arguments.rest else Hand(client, load_scene(arguments.scene)),
            WatchedPage(studio.url, width, height, bench=not arguments.stage) as page,
        ):
            measure(page, arguments.seconds, arguments.warm)
            errors = page.errors
    print("\n".join(errors), file=sys.stderr, end="")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
