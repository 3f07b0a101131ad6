"""Devices of other packages, registered as entry points of the group "punctura.devices" (docs/devices.md).

An entry point names a module or an object with `open(rate, device)`, which returns a Device (a FedDevice that a thread
of its own feeds), and with `status()`, which returns a dict with state, detail and devices as in BackendState. The name
of the entry point is the name for `--device`.
"""

from __future__ import annotations

from importlib.metadata import EntryPoint, entry_points

from punctura import _core
from punctura._core import Device, DeviceError
from punctura.results import BackendState

GROUP = "punctura.devices"
LONGEST = 500  # characters of a text that a package gives


def enumerate_devices() -> list[BackendState]:
    """Every kind of device; those of other packages first. Gives no force."""
    own = _core.enumerate_devices()
    return plug_in_states({entry["backend"] for entry in own}) + own


def plug_in_states(taken: set[str]) -> list[BackendState]:
    """The devices of other packages. taken: the names of Punctura's own devices, which no package can replace."""
    named: dict[str, EntryPoint] = {}
    return [_status(found, taken, named.setdefault(_printable(found.name), found)) for found in _all()]


def plug_in_names() -> list[str]:
    """Their names. Runs no code of the packages."""
    return list(dict.fromkeys(_printable(found.name) for found in _all()))


def open_plug_in(backend: str, rate: float, device: str) -> Device:
    """backend: one of plug_in_names(). Raises DeviceError, whatever the package has raised."""
    found = next(found for found in _all() if _printable(found.name) == backend)
    try:
        opened = found.load().open(rate, device)
    except DeviceError as error:
        raise DeviceError(_printable(_text(error))) from error
    except (Exception, SystemExit) as error:
        raise DeviceError(_printable(f"{found.name} ({found.value}) cannot be opened: {_reason(error)}")) from error
    if not isinstance(opened, Device):
        returned = type(opened).__name__
        raise DeviceError(_printable(f"{found.name} ({found.value}): open() returned {returned}, not a Device"))
    return opened


def _all() -> list[EntryPoint]:
    """In a fixed order, whatever the order of the folders on the disk."""
    found = set(entry_points(group=GROUP))
    return sorted(found, key=lambda one: (_printable(one.name), one.value.casefold(), one.value))


def _printable(text: object) -> str:
    """One line that every terminal and the page can show, whatever a package says."""
    words = " ".join(str(text).split())
    shown = "".join(character if character.isprintable() else "?" for character in words)
    return shown if len(shown) <= LONGEST else shown[:LONGEST] + " ..."


def _reason(error: BaseException) -> str:
    """The type and text of an error, even of one that has no text: its __str__ may raise."""
    try:
        return f"{type(error).__name__}: {error}"
    except Exception:
        return type(error).__name__


def _text(error: DeviceError) -> str:
    """The text alone; without one, the type."""
    try:
        return str(error)
    except Exception:
        return type(error).__name__


def _status(found: EntryPoint, taken: set[str], first: EntryPoint) -> BackendState:
    """A package that fails must not hide the other devices. first: the entry point that has its name."""
    entry = BackendState(backend=_printable(found.name), state="fault", detail="", devices=[])
    if found.name in taken:
        entry["detail"] = _printable(f"{found.value}: Punctura has a device of this name; choose another one")
        return entry
    if first != found:
        told = f"{found.value} does not run: {first.value} has a device of the same name; uninstall one of the packages"
        entry["detail"] = _printable(told)
        return entry
    try:
        said = found.load().status()
        return BackendState(
            backend=_printable(found.name),
            state=_printable(said["state"]),
            detail=_printable(said.get("detail", "")),
            devices=[_printable(name) for name in said.get("devices", [])],
        )
    except (Exception, SystemExit) as error:
        entry["detail"] = _printable(f"{found.value}: {_reason(error)}")
        return entry
