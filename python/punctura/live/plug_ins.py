"""Devices of other packages, registered as entry points of the group "punctura.devices" (docs/devices.md).

An entry point names a module or an object with `open(rate, device)`, which returns a Device (a FedDevice that a thread
of its own feeds), and with `status()`, which returns a dict with state, detail and devices as in BackendState. The name
of the entry point is the name for `--device`. status_probe.py calls `status()`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, get_args

from punctura import _core
from punctura._core import Device, DeviceError
from punctura.live.status_probe import probe
from punctura.process.signals import Ended
from punctura.results import BackendState, DeviceState

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

GROUP = "punctura.devices"
LONGEST = 500  # characters of a text that a package gives


def enumerate_devices() -> list[BackendState]:
    """Every kind of device; those of other packages first. Gives no force."""
    own = _core.enumerate_devices()
    return plug_in_states({entry["backend"] for entry in own}) + own


def plug_in_states(taken: set[str]) -> list[BackendState]:
    """The devices of other packages. taken: the names of Punctura's own devices, which no package can replace."""
    named: dict[str, EntryPoint] = {}
    refused = {found: _refusal(found, taken, named.setdefault(_printable(found.name), found)) for found in _all()}
    asked = [found for found, why in refused.items() if not why]
    answers = dict(zip(asked, probe(asked), strict=True))
    return [_fault(found, why) if why else _state(found, answers[found]) for found, why in refused.items()]


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
    except (KeyboardInterrupt, Ended):
        raise
    except BaseException as error:  # also SystemExit and CancelledError
        raise DeviceError(_printable(f"{found.name} ({found.value}) cannot be opened: {_reason(error)}")) from error
    if not isinstance(opened, Device):
        returned = type(opened).__name__
        raise DeviceError(_printable(f"{found.name} ({found.value}): open() returned {returned}, not a Device"))
    return opened


def _all() -> list[EntryPoint]:
    """In a fixed order, whatever the order of the folders on the disk."""
    from importlib.metadata import entry_points  # takes long, and the physics does not need it

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


def _fault(found: EntryPoint, detail: str) -> BackendState:
    shown = _printable(f"{found.value}: {detail}")
    return BackendState(backend=_printable(found.name), state="fault", detail=shown, devices=[])


def _refusal(found: EntryPoint, taken: set[str], first: EntryPoint) -> str:
    """Why this package is not asked at all; empty if it is. first: the entry point that has its name."""
    if found.name in taken:
        return "Punctura has a device of this name; choose another one"
    if first != found:
        return f"does not run, because {first.value} has a device of the same name; uninstall one of the packages"
    if ":" in found.name:
        return "a name with a colon cannot be chosen; change the name of the entry point"
    return ""


def _state(found: EntryPoint, answer: dict[str, object]) -> BackendState:
    """answer: what its status() returned, or what is wrong with it."""
    if "error" in answer:
        return _fault(found, str(answer["error"]))
    given, detail, devices = answer.get("state"), answer.get("detail", ""), answer.get("devices", [])
    state = next((known for known in get_args(DeviceState) if known == given), None)
    if state is None:
        returned = answer.get("returned", f"{{'state': {given!r}, ...}}")
        known = ", ".join(get_args(DeviceState))
        return _fault(found, f"status() must return a dict whose state is one of {known}; it is {returned}")
    if not isinstance(devices, list):
        return _fault(found, f"devices of status() must be a list of names; it is {devices!r}")
    return BackendState(
        backend=_printable(found.name),
        state=state,
        detail=_printable(detail),
        devices=[_printable(device) for device in devices],
    )
