"""The second device: under the thumb, on the plunger of the scene's syringe (docs/syringe.md)."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from punctura import Scene
from punctura._core import Device, DeviceError, ReplayDevice, SimulatedDevice, Strokes, ThumbLoop
from punctura.live.choose import ANY_PROCESSOR, open_for
from punctura.live.limits import RunLimits

DOWN = (0.0, -1.0, 0.0)
STROKE_M, STROKE_S, REST_S = 6e-3, 3.0, 1.0  # of the simulated thumb; illustrative


class SecondDeviceError(DeviceError):
    """The second device cannot be used; the text says what to do."""


class SecondDevice(NamedTuple):
    """The choice of a device for the thumb. name: of `punctura devices`. direction: of a push, in device axes."""

    name: str
    direction: tuple[float, float, float] = DOWN

    def open(self, scene: Scene, needle: Device, processor: int = ANY_PROCESSOR) -> Device:
        """Opens the device. A simulated thumb pushes and lets go, again and again. Raises SecondDeviceError.

        scene: must have a syringe, so that a device that can never give force is not opened.
        """
        if scene.syringe is None:
            raise SecondDeviceError(
                f"a second device pushes the plunger of a syringe, and the scene {scene.name} has no [syringe]; "
                "the ready scene epidural has one"
            )
        if isinstance(needle, ReplayDevice):
            raise SecondDeviceError("a replay plays the recorded thumb, too: leave the second device out")
        if self.name.partition(":")[0] == "replay":
            raise SecondDeviceError("a replay can only be the needle's device")
        if self.name == "simulated":
            return SimulatedDevice(self._strokes(), rate=scene.servo.rate, processor=processor)
        try:
            opened = open_for(scene, self.name, processor)
        except DeviceError as error:
            raise SecondDeviceError(str(error)) from None
        if opened is needle:
            raise SecondDeviceError(f"{self.name} is the needle's device; the thumb needs one of its own")
        return opened

    def again(self, before: Device) -> Device:
        """The device for the next run: a real one as it is, a simulated one made again with motors as warm."""
        if not isinstance(before, SimulatedDevice):
            return before
        fresh = SimulatedDevice(self._strokes(), rate=before.info.rate)
        fresh.go_on_from(before)
        return fresh

    def loop(self, device: Device, limits: RunLimits) -> ThumbLoop:
        """The thumb's loop, for ServoLoop(thumb=...). Raises ConfigurationError.

        It has the force and input limits of the needle's device. A dead-man button is that of the needle's device
        alone, which ends the force of both.
        """
        own = limits._replace(gate={key: value for key, value in limits.gate.items() if key != "dead_man"})
        return ThumbLoop(device, self.direction, own.gate_on(device), limits.force)

    def _strokes(self) -> Strokes:
        length = math.hypot(*self.direction)
        end = [STROKE_M * part / length for part in self.direction]
        return Strokes([0, 0, 0], end, count=1000, duration=STROKE_S, rest=REST_S)


def direction_of(text: str) -> tuple[float, float, float]:
    """The direction of a text such as "0,-1,0". Raises ValueError."""
    try:
        parts: Sequence[float] = [float(part) for part in text.split(",")]
    except ValueError:
        parts = ()
    if len(parts) != 3:
        raise ValueError(f"must be three numbers with commas between them, such as 0,-1,0; it is {text!r}")
    x, y, z = parts
    if not 0 < math.hypot(x, y, z) < math.inf:
        raise ValueError(f"must be three finite numbers, not all 0; it is {text!r}")
    return x, y, z
