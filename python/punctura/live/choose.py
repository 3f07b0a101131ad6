"""Selects the device, and fits a scene to it; also the default motion of a simulated hand."""

import math
import warnings
from collections.abc import Mapping

from punctura import Scene
from punctura._core import (
    Device,
    DeviceError,
    GateLimits,
    SimulatedDevice,
    Strokes,
    enumerate_devices,
    open_device,
    stroke_ends,
)
from punctura.live.plug_ins import open_plug_in, plug_in_names, plug_in_states
from punctura.results import BackendState

ANY_PROCESSOR = -1


def strokes_through(scene: Scene, count: int = 1000, duration: float = 2.0) -> Strokes:
    """Strokes along the first membrane's normal, from in front of all membranes to behind the last."""
    start, end = stroke_ends(scene)
    return Strokes(start, end, count=count, duration=duration, rest=0.7, variation=0.05)


class DeviceWarning(UserWarning):
    """The device of another package cannot be used."""


def open_for(scene: Scene, name: str = "", processor: int = ANY_PROCESSOR) -> Device:
    """Opens the device `backend` or `backend:device`; by default the first available one, else the simulated.

    `replay:FILE` is a recorded motion. processor: to tick on, if the thread belongs to Punctura. Raises DeviceError,
    which lists the devices, or says what to do.
    """
    backend, _, device = name.partition(":")
    if backend == "replay":
        return _replay(device, processor)
    own = {entry["backend"]: entry for entry in enumerate_devices()}
    if not name:
        backend = _first_available(own)
    if backend == "simulated":
        if device:
            raise DeviceError(f"there is one simulated device only, and none of the name {device!r}: simulated")
        axis = scene.membranes[0].inward_normal
        return SimulatedDevice(strokes_through(scene), rate=scene.servo.rate, axis=axis, processor=processor)
    if backend in own:
        return open_device(backend, scene.servo.rate, device, processor=processor)
    plug_ins = [name for name in plug_in_names() if name not in own and ":" not in name]
    if backend not in plug_ins:
        raise DeviceError(f"no device is called {backend!r}; there are: {', '.join([*plug_ins, *own])}")
    return open_plug_in(backend, scene.servo.rate, device)


def _first_available(own: Mapping[str, BackendState]) -> str:
    """Asks every package. For a device that was named, none is asked: a status() that hangs would end the start."""
    packages = plug_in_states(set(own))
    for entry in packages:
        if entry["state"] == "fault":
            warnings.warn(f"{entry['backend']} is left out: {entry['detail']}", DeviceWarning, stacklevel=2)
    for entry in [*packages, *own.values()]:
        if entry["state"] == "available" and entry["backend"] != "simulated":
            return entry["backend"]
    return "simulated"


def _replay(file: str, processor: int) -> Device:
    from punctura.record import RecordingError, replay_device  # a run on hardware does not wait for it

    if not file:
        raise DeviceError("a replay needs a recording: replay:FILE.parquet")
    try:
        return replay_device(file, processor=processor)
    except RecordingError as bad:
        raise DeviceError(str(bad)) from None


def gate_for(device: Device) -> GateLimits:
    """The default input limits: the core's, except that a simulated device may be late by one second.

    Nobody holds a simulated device, so a short pause of the computer need not stop it.
    """
    return GateLimits(stale=1.0, deadline=1.0) if isinstance(device, SimulatedDevice) else GateLimits()


def fit_direction(scene: Scene, device: Device) -> tuple[Scene, str]:
    """The scene for this device, and a note, empty if the scene is unchanged.

    If the device reports no orientation, the needle points where its tip moves.
    """
    if scene.direction == "motion" or device.info.has_orientation:
        return scene, ""
    return scene.replace(direction="motion"), "the device reports no orientation: the needle points where the tip moves"


def fit_conditioning(scene: Scene, device: Device) -> tuple[Scene, str]:
    """The scene with positions conditioned for this device's encoders (docs/conditioning.md), and a note.

    The scene is unchanged, and the note empty, if the device does not report its encoder step.
    """
    step = device.info.encoder_step
    if not math.isfinite(step):
        return scene, ""
    servo = scene.servo.replace(conditioning="line_fit", encoder_step=step)
    return scene.replace(servo=servo), f"positions are conditioned for encoder steps of {step * 1e3:g} mm"
