"""Runs a scene on a device, as `punctura run` does, for programs."""

from punctura._core import (
    Device,
    DeviceError,
    DeviceInfo,
    Fault,
    FedDevice,
    ForceLimits,
    GateLimits,
    Limit,
    LiveEstimate,
    Pacer,
    Placement,
    ReplayDevice,
    ServoLoop,
    ServoState,
    SimulatedDevice,
    ThumbLoop,
    make_realtime,
    needed_damping,
    open_device,
    stroke_ends,
)
from punctura.device_words import room_note
from punctura.live.choose import ANY_PROCESSOR, fit_conditioning, fit_direction, gate_for, open_for, strokes_through
from punctura.live.force_words import MODEL_FORCE, felt_force
from punctura.live.limits import RunLimits, load_limits
from punctura.live.placement import load_placement, placement_from_pose, placement_text, present_pose
from punctura.live.plug_ins import enumerate_devices
from punctura.live.run_notes import damping_note, run_notes
from punctura.live.second import SecondDevice, SecondDeviceError, direction_of
from punctura.live.session import run_live
from punctura.live.summary import RunSummary
from punctura.process.dropping_stream import DroppingStream
from punctura.process.signals import Ended
from punctura.results import BackendState, LoopReport, Quantiles

__all__ = [
    "ANY_PROCESSOR",
    "MODEL_FORCE",
    "BackendState",
    "Device",
    "DeviceError",
    "DeviceInfo",
    "DroppingStream",
    "Ended",
    "Fault",
    "FedDevice",
    "ForceLimits",
    "GateLimits",
    "Limit",
    "LiveEstimate",
    "LoopReport",
    "Pacer",
    "Placement",
    "Quantiles",
    "ReplayDevice",
    "RunLimits",
    "RunSummary",
    "SecondDevice",
    "SecondDeviceError",
    "ServoLoop",
    "ServoState",
    "SimulatedDevice",
    "ThumbLoop",
    "damping_note",
    "direction_of",
    "enumerate_devices",
    "felt_force",
    "fit_conditioning",
    "fit_direction",
    "gate_for",
    "load_limits",
    "load_placement",
    "make_realtime",
    "needed_damping",
    "open_device",
    "open_for",
    "placement_from_pose",
    "placement_text",
    "present_pose",
    "room_note",
    "run_live",
    "run_notes",
    "stroke_ends",
    "strokes_through",
]
