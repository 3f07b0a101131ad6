"""One run: a scene on a device from tick 0 on, with its ring of snapshots and, if wanted, its recording."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from punctura import Scene, Target
from punctura._core import Device, Placement, ServoLoop, SimulatedDevice
from punctura.live import ANY_PROCESSOR, Limits, fit_conditioning, fit_direction, open_for, room_note
from punctura.record import Recorder
from punctura.studio.hand import Pose, resting_pose
from punctura.studio.loaded import Loaded
from punctura.studio.wire.frames import Columns


@dataclass(frozen=True)
class Settings:
    """What the command line has asked for. device: as `punctura devices` names it; empty is the best there is."""

    device: str = ""
    placement: Placement = field(default_factory=Placement)
    scene_filter: bool = False  # positions are filtered as the scene says, not as the device needs
    limits: Limits = field(default_factory=Limits)
    processor: int = ANY_PROCESSOR  # that ticks


class Bench:
    """The device that runs are made on. A simulated one is new with every run, a real one stays open."""

    def __init__(self, settings: Settings, scene: Scene) -> None:
        """Raises DeviceError."""
        self.settings = settings
        self._device = open_for(scene, settings.device, settings.processor)

    @property
    def simulated(self) -> bool:
        return isinstance(self._device, SimulatedDevice)

    @property
    def device(self) -> Device:
        return self._device

    @property
    def simulated_device(self) -> SimulatedDevice:
        """Only where `simulated`."""
        assert isinstance(self._device, SimulatedDevice)
        return self._device

    def fresh(self, scene: Scene, pose: Pose) -> Device:
        """For a new run; a simulated hand holds it in this pose."""
        if self.simulated:
            where, before = self.settings.processor, self._device
            self._device = SimulatedDevice(Target(pose[0]), rate=scene.servo.rate, axis=pose[1], processor=where)
            self._device.go_on_from(before)  # whose motors do not cool because a new run begins
        return self._device

    def fit(self, scene: Scene) -> tuple[Scene, list[str]]:
        """The scene as the device can run it, and what was done to it."""
        fitted, note = fit_direction(scene, self._device)
        notes = [note]
        if not self.settings.scene_filter:
            fitted, note = fit_conditioning(fitted, self._device)
            notes.append(note)
        return fitted, [n for n in notes if n]


class Run:
    """A loop that ticks from `start` to `stop`. Of one thread."""

    def __init__(
        self,
        number: int,
        bench: Bench,
        loaded: Loaded,
        recording: Path | None = None,
        about: dict[str, Any] | None = None,
        pose: Pose | None = None,
    ) -> None:
        """about: of the recording. pose: of the hand. Raises ConfigurationError, DeviceError, RecordingError."""
        self.number = number
        self.loaded = loaded
        self.pose = pose or resting_pose(loaded.scene)
        self.scenes = 0  # that have been exchanged
        self._bench = bench
        device = bench.fresh(loaded.scene, self.pose)
        scene, self.notes = bench.fit(loaded.scene)
        limits = bench.settings.limits
        self.loop = ServoLoop(device, scene, limits.gate_on(device), limits.force, bench.settings.placement)
        self._listener = self.loop.listen()
        self.notes += [*limits.notes(self.loop), *filter(None, [room_note(self.loop)])]
        self.recorder = Recorder(self.loop, recording, about=about) if recording else None

    def start(self) -> None:
        """Ticks come; force, too, where the loop was armed, once the tip is outside tissue."""
        self.loop.start()

    def stop(self) -> None:
        """Zero force, no tick any more; a recording's file is left to `finish`."""
        self.loop.stop()

    def exchange(self, loaded: Loaded) -> None:
        """Another scene between two ticks. Raises ConfigurationError; then nothing has changed."""
        scene, _ = self._bench.fit(loaded.scene)
        take: Callable[[Scene], None] = self.recorder.exchange if self.recorder else self.loop.exchange
        take(scene)
        self.loaded = loaded
        self.scenes += 1

    def read(self) -> Columns:
        """All ticks since the last read, as columns."""
        return self._listener.read()

    @property
    def lost(self) -> int:
        """Snapshots that found no room in the ring."""
        return int(self._listener.lost)

    @property
    def rate(self) -> float:
        return float(self.loop.device.info.rate)
