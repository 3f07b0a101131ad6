"""Runs of the simulated device, recorded."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from punctura import Scene, load_scene
from punctura._core import ForceLimits, GateLimits, Listener, ServoLoop, SimulatedDevice
from punctura.record import Recorder
from punctura.simulation import Strokes
from waiting import wait_until

STROKES = Strokes((0, 5e-3, 0), (0, -0.02, 0), count=100, duration=0.3, rest=0.1)


class Run:
    """A loop on a device without a clock, its recorder, and a second listener to compare with."""

    def __init__(self, path: Path, ticks: int, scene: str | Scene, capacity: int | None, **more: Any) -> None:
        self.path = path
        self.ticks = ticks
        self.device = SimulatedDevice(STROKES, real_time=False, ticks=ticks, **more.pop("device", {}))
        gate, limits = more.pop("gate", GateLimits()), more.pop("limits", ForceLimits())
        self.loop = ServoLoop(self.device, load_scene(scene) if isinstance(scene, str) else scene, gate, limits)
        self.witness: Listener = self.loop.listen(ticks)
        self.recorder = Recorder(self.loop, path, capacity or ticks)
        if capacity is None:  # the device runs without a clock, so a full ring can lose ticks
            assert self.recorder._listener.capacity >= ticks

    def go(self) -> None:
        """Runs all ticks, armed."""
        self.loop.arm()
        total = self.loop.report()["ticks"] + self.ticks
        self.loop.start()
        self.wait(lambda: self.loop.report()["ticks"] == total)
        self.loop.stop()

    def overflow(self) -> Run:
        """Makes ticks while the ring is full, and more after it was emptied, so that there is a gap in the middle."""
        self.go()
        self.wait(lambda: self.recorder.status().rows > 0)
        self.go()
        self.recorder.finish()
        return self

    def record(self) -> Run:
        self.go()
        self.recorder.finish()
        return self

    def killed(self, kept: Path) -> Path:
        """Copies the file of a process that is killed after the last tick to `kept`."""
        self.go()
        self.wait(lambda: self.recorder.status().rows == self.ticks)
        shutil.copy(self.recorder.status().file, kept)
        self.recorder.finish()
        return kept

    wait = staticmethod(wait_until)


Start = Callable[..., Run]


@pytest.fixture
def start(tmp_path: Path) -> Start:
    """Creates a run that is ready to start."""

    def make(ticks: int = 3000, scene: str | Scene = "k06-fig12", capacity: int | None = None, **more: Any) -> Run:
        return Run(tmp_path / more.pop("name", "run.parquet"), ticks, scene, capacity, **more)

    return make
