"""Devices of other packages, registered as entry points of the group "punctura.devices" (docs/devices.md).

An entry point names a module or an object with `open(rate, device)`, which returns a Device (a FedDevice that a thread
of its own feeds), and with `status()`, which returns a dict with state, detail and devices as in BackendState. The name
of the entry point is the name for `--device`. `status()` is called in a thread of its own, so that it may hang.
"""

from __future__ import annotations

import threading
from importlib.metadata import EntryPoint, entry_points
from typing import get_args

from punctura import _core
from punctura._core import Device, DeviceError
from punctura.results import BackendState, DeviceState

GROUP = "punctura.devices"
LONGEST = 500  # characters of a text that a package gives
STATUS_S = 10.0  # for the import of a package and its status(), which may search a bus


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
        raise DeviceError(_printable(_reason(error, typed=False))) from error
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # also SystemExit and CancelledError
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


def _reason(error: BaseException, typed: bool = True) -> str:
    """The type and text of an error; without a text (its __str__ may raise, too) the type alone."""
    name = type(error).__name__
    try:
        text = str(error)
    except Exception:
        return name
    return f"{name}: {text}" if typed else text


def _status(found: EntryPoint, taken: set[str], first: EntryPoint) -> BackendState:
    """A package that fails must not hide the other devices. first: the entry point that has its name."""
    name = _printable(found.name)
    if found.name in taken:
        return _fault(name, f"{found.value}: Punctura has a device of this name; choose another one")
    if first != found:
        told = f"{found.value} does not run: {first.value} has a device of the same name; uninstall one of the packages"
        return _fault(name, told)
    if ":" in name:
        told = f"{found.value}: a name with a colon cannot be chosen; change the name of the entry point"
        return _fault(name, told)
    answers: list[BackendState] = []
    thread = threading.Thread(target=lambda: answers.append(_asked(found)), name=f"status of {name}", daemon=True)
    thread.start()
    thread.join(STATUS_S)
    return answers[0] if answers else _fault(name, f"{found.value}: no answer from status() within {STATUS_S:g} s")


def _asked(found: EntryPoint) -> BackendState:
    """The package's answer, or what is wrong with it."""
    name = _printable(found.name)
    try:
        said = found.load().status()
        if not isinstance(said, dict) or said.get("state") not in get_args(DeviceState):
            told = f"status() must return a dict whose state is one of {', '.join(get_args(DeviceState))}; it is"
            return _fault(name, f"{found.value}: {told} {said!r}")
        detail, devices = said.get("detail", ""), said.get("devices", [])
        if isinstance(devices, str):
            return _fault(name, f"{found.value}: devices of status() must be a list of names; it is {devices!r}")
        shown = [_printable(device) for device in devices]
        return BackendState(backend=name, state=said["state"], detail=_printable(detail), devices=shown)
    except BaseException as error:  # also SystemExit and CancelledError; Ctrl-C goes to another thread
        return _fault(name, f"{found.value}: {_reason(error)}")


def _fault(name: str, detail: str) -> BackendState:
    return BackendState(backend=name, state="fault", detail=_printable(detail), devices=[])
