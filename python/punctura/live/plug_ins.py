"""Devices that other packages bring, as entry points of the group "punctura.devices" (docs/devices.md).

An entry point names a module or an object with `open(rate, device)`, which returns a Device (a FedDevice that a thread
of its own feeds), and with `status()`, a dict of state, detail and devices as `enumerate_devices` gives it. The name of
the entry point is the name for `--device`.
"""

from __future__ import annotations

from importlib.metadata import EntryPoint, entry_points
from typing import Any

from punctura import _core
from punctura._core import Device, DeviceError

GROUP = "punctura.devices"


def enumerate_devices() -> list[dict[str, Any]]:
    """Of each kind of device a dict: backend, state, detail, devices; those of other packages first. Gives no force."""
    own = _core.enumerate_devices()
    return plug_in_states({entry["backend"] for entry in own}) + own


def plug_in_states(taken: set[str]) -> list[dict[str, Any]]:
    """The entries of other packages. taken: the names of Punctura's own devices, which none can take over."""
    return [_status(found, taken) for found in _found().values()]


def open_plug_in(backend: str, rate: float, device: str) -> Device:
    """backend: a name that plug_in_states() lists. Raises DeviceError, whatever the package has raised."""
    found = _found()[backend]
    try:
        opened = found.load().open(rate, device)
    except DeviceError:
        raise
    except Exception as error:
        raise DeviceError(f"{found.name} ({found.value}) cannot be opened: {type(error).__name__}: {error}") from error
    if not isinstance(opened, Device):
        raise DeviceError(f"{found.name} ({found.value}): open() returned {type(opened).__name__}, not a Device")
    return opened


def _found() -> dict[str, EntryPoint]:
    return {found.name: found for found in entry_points(group=GROUP)}


def _status(found: EntryPoint, taken: set[str]) -> dict[str, Any]:
    """A package that fails must not hide the other devices."""
    entry: dict[str, Any] = {"backend": found.name, "state": "fault", "detail": "", "devices": []}
    if found.name in taken:
        return entry | {"detail": f"{found.value}: Punctura has a device of this name; choose another one"}
    try:
        said = found.load().status()
        return entry | {
            "state": str(said["state"]),
            "detail": str(said.get("detail", "")),
            "devices": [str(name) for name in said.get("devices", [])],
        }
    except Exception as error:
        return entry | {"detail": f"{found.value}: {type(error).__name__}: {error}"}
