"""One run: a scene on a device from tick 0 on, with its ring of snapshots and an optional recording."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from punctura import Scene
from punctura._core import Device, Fault, Placement, ServoLoop, SimulatedDevice, Target, ThumbLoop
from punctura.live import ANY_PROCESSOR, RunLimits, SecondDevice, fit_conditioning, fit_direction, open_for, run_notes
from punctura.record import Recorder
from punctura.results import JsonObject
from punctura.studio.hand import Pose, resting_pose
from punctura.studio.loaded import Loaded
from punctura.ticks import Ticks

NO_SYRINGE = "this scene has no syringe: the second device gives no force"


@dataclass(frozen=True)
class Settings:
    """Options of the command line. device: a name from `punctura devices`; empty selects the first available."""

    device: str = ""
    placement: Placement = field(default_factory=Placement)
    scene_filter: bool = False  # filter positions as the scene says, not as the device needs
    limits: RunLimits = field(default_factory=RunLimits)
    processor: int = ANY_PROCESSOR  # to tick on
    second: SecondDevice | None = None  # under the thumb


class Bench:
    """The device for all runs. A simulated device is new for every run, a real one stays open."""

    def __init__(self, settings: Settings, scene: Scene) -> None:
        """Raises DeviceError."""
        self.settings = settings
        self._device = open_for(scene, settings.device, settings.processor)
        second = settings.second
        self._second = second.open(scene, self._device, settings.processor) if second else None

    @property
    def simulated(self) -> bool:
        return isinstance(self._device, SimulatedDevice)

    @property
    def device(self) -> Device:
        return self._device

    @property
    def second_model(self) -> str:
        """The model of the second device; empty without one."""
        return self._second.info.model if self._second else ""

    @property
    def simulated_device(self) -> SimulatedDevice:
        """Only where `simulated`."""
        assert isinstance(self._device, SimulatedDevice)
        return self._device

    def fresh(self, scene: Scene, pose: Pose) -> Device:
        """The device for a new run; a simulated hand holds it in this pose."""
        if self.simulated:
            where, before = self.settings.processor, self._device
            self._device = SimulatedDevice(Target(pose[0]), rate=scene.servo.rate, axis=pose[1], processor=where)
            self._device.go_on_from(before)  # its motors do not cool because a new run begins
        return self._device

    def fresh_thumb(self) -> ThumbLoop | None:
        """The loop of the second device for a new run; None without one. Raises ConfigurationError."""
        second = self.settings.second
        if second is None or self._second is None:
            return None
        self._second = second.again(self._second)
        return second.loop(self._second, self.settings.limits)

    def fit(self, scene: Scene) -> tuple[Scene, list[str]]:
        """The scene as the device can run it, and notes on what was changed."""
        fitted, note = fit_direction(scene, self._device)
        notes = [note]
        if not self.settings.scene_filter:
            fitted, note = fit_conditioning(fitted, self._device)
            notes.append(note)
        return fitted, [n for n in notes if n]


class Run:
    """A loop that ticks from `start` to `stop`. Belongs to one thread."""

    def __init__(
        self,
        number: int,
        bench: Bench,
        loaded: Loaded,
        recording: Path | None = None,
        about: JsonObject | None = None,
        pose: Pose | None = None,
    ) -> None:
        """about: for the header. pose: of the hand. Raises ConfigurationError, DeviceError, RecordingError."""
        self.number = number
        self.loaded = loaded
        self.pose = pose or resting_pose(loaded.scene)
        self.scenes = 0  # number of exchanged scenes
        self._bench = bench
        device = bench.fresh(loaded.scene, self.pose)
        scene, self.notes = bench.fit(loaded.scene)
        limits = bench.settings.limits
        self.thumb = bench.fresh_thumb()
        gate, placement = limits.gate_on(device), bench.settings.placement
        self.loop = ServoLoop(device, scene, gate, limits.force, placement, self.thumb)
        self._listener = self.loop.listen()
        self.notes += [*limits.notes(self.loop, self.thumb), *run_notes(self.loop)]
        if self.thumb is not None and scene.syringe is None:
            self.notes.append(NO_SYRINGE)
        self.recorder = Recorder(self.loop, recording, about=about, thumb=self.thumb) if recording else None

    def start(self) -> None:
        """Starts the ticks. An armed loop gives force once the tip is outside tissue."""
        self.loop.start()

    def stop(self) -> None:
        """Sets zero force and ends the ticks; the recording's `finish` completes its file."""
        self.loop.stop()

    def exchange(self, loaded: Loaded) -> None:
        """Exchanges the scene between two ticks. Raises ConfigurationError; then nothing has changed."""
        scene, _ = self._bench.fit(loaded.scene)
        take: Callable[[Scene], None] = self.recorder.exchange if self.recorder else self.loop.exchange
        take(scene)
        self.loaded = loaded
        self.scenes += 1

    def read(self, most: int | None = None) -> Ticks:
        """The oldest ticks that were not read yet, at most so many; all if not given."""
        return self._listener.read(most)

    @property
    def fault(self) -> Fault:
        """Of the last tick."""
        ticks = self.loop.latest()
        return Fault(int(ticks.fault[-1])) if len(ticks) else Fault.none

    @property
    def silence(self) -> str:
        """Why ticks that ceased have ended the run; otherwise empty."""
        return self.loop.silence

    @property
    def lost(self) -> int:
        """Snapshots that found no room in the ring."""
        return int(self._listener.lost)

    @property
    def rate(self) -> float:
        return float(self.loop.device.info.rate)
