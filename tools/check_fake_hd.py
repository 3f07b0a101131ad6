"""Checks the fake HD library of OpenHaptics with an independent public client. This tests the fake, not Punctura.

python tools/check_fake_hd.py [FAKE_LIBRARY]     after ./test cpp

Installs pyOpenHaptics (MIT) from PyPI into build/fake-hd-check, unmodified, and lets it find the fake under the real
library's name.
"""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
import time
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PLACE = ROOT / "build" / "fake-hd-check"
FAKE = ROOT / "build/dev/tests/runtime/fakes/hd/fake_hd.so"
CLIENT = "pyOpenHaptics==1.0.1"
ERROR_AT_BEGIN, UNPLUG = 0, 3  # enum fake_hd_fault


class Record(ctypes.Structure):
    """fake_hd_record, tests/fakes/hd/fake_hd.h."""

    _fields_ = (("time", ctypes.c_double), ("position", ctypes.c_double * 3), ("force", ctypes.c_double * 3))


def drive() -> None:
    """Runs in the client's environment. Checks each rule of the library that the back-end relies on."""
    from pyOpenHaptics import hd, hd_callback, hd_define, hd_device  # type: ignore[import-not-found]

    control = ctypes.CDLL("libHD.so")
    control.fake_hd_inject.argtypes = [ctypes.c_int, ctypes.c_uint, ctypes.c_ulonglong, ctypes.c_ulonglong]
    for name in ("fake_hd_ticks", "fake_hd_misuses", "fake_hd_records"):
        getattr(control, name).restype = ctypes.c_ulonglong
    control.fake_hd_records.argtypes = [ctypes.POINTER(Record), ctypes.c_ulonglong]
    checks = 0
    calls: list[tuple[float, ...]] = []
    buttons: list[int] = []

    def check(what: str, holds: bool) -> None:
        nonlocal checks
        checks += 1
        if not holds:
            sys.exit(f"the client and the fake disagree: {what}")

    def error() -> int:
        return int(hd._get_error().errorCode)

    def held() -> list[float]:
        force = (ctypes.c_double * 3)()
        control.fake_hd_held_force(force)
        return list(force)

    def feel() -> None:
        matrix = hd.get_transform()
        calls.append((matrix[3][0], matrix[3][1], matrix[3][2], matrix[2][0], matrix[2][1], matrix[2][2]))
        buttons.append(hd.get_buttons())
        hd.set_force([0.25, -0.5, 0.125])

    operation = hd_callback.hd_callback(feel)
    control.fake_hd_reset(None)
    check("no error at first", error() == hd_define.HD_SUCCESS)
    check("a name that no device has", hd._lib_hd.hdInitDevice(b"Nobody's") in (-1, hd_define.HD_INVALID_HANDLE))
    check("and its error", error() == hd_define.HD_BAD_HANDLE)
    for rate, answer in ((1600, hd_define.HD_SUCCESS), (1700, hd_define.HD_INVALID_VALUE)):
        control.hdSetSchedulerRate(ctypes.c_ulong(rate))
        check(f"{rate} Hz", error() == answer)

    began, before = time.monotonic(), control.fake_hd_ticks()
    device = hd_device.HapticDevice(operation)
    check("model and vendor", (hd.get_model(), hd.get_vendor()) == ("Simulated Omni", "Nobody"))
    time.sleep(1)
    seconds, ticks = time.monotonic() - began, control.fake_hd_ticks() - before
    rate = ticks / seconds
    check(f"about 1600 calls a second, not {rate:.0f}", 800 < rate < 1700)
    check(f"a call a tick, {len(calls)} of {ticks}", abs(len(calls) - ticks) < 0.05 * ticks)
    check("rate as read", hd._get_integerv(hd_define.HD_UPDATE_RATE, ctypes.c_int).value == 1600)
    check("force taken, to the last bit", held() == [0.25, -0.5, 0.125])
    check("buttons", set(buttons) == {0})
    records = (Record * 200)()
    check("records", control.fake_hd_records(records, 200) == 200)
    positions = {call[:3] for call in calls}
    seen = sum(tuple(record.position) in positions for record in records[20:])
    check("translation in the last column, mm", seen >= 175)
    check("the stylus points against the third column", calls[-1][3:] == (0.0, 1.0, 0.0))
    force = (ctypes.c_double * 3)(1, 1, 1)
    misuses = control.fake_hd_misuses()

    control.fake_hd_inject(ERROR_AT_BEGIN, hd_define.HD_FORCE_ERROR, control.fake_hd_ticks() + 5, 1)
    time.sleep(0.2)
    check("a call that says done is the last", control.fake_hd_operations() == 0)
    hd._lib_hd.hdSetDoublev(hd_define.HD_CURRENT_FORCE, ctypes.cast(force, ctypes.POINTER(hd.hduVector3Dd)))
    check("a force outside a frame", error() == hd_define.HD_FRAME_ERROR)
    check("goes nowhere", held() == [0.25, -0.5, 0.125])
    hd.end_frame(device.id)
    check("an end without a begin", error() == hd_define.HD_ILLEGAL_END)
    check("both counted", control.fake_hd_misuses() == misuses + 2)
    control.fake_hd_inject(UNPLUG, 0, control.fake_hd_ticks(), 1)
    time.sleep(0.05)
    hd.stop_scheduler()
    hd.begin_frame(device.id)
    info = hd._get_error()
    check("unplugged, by value", (info.errorCode, info.internalErrorCode) == (hd_define.HD_COMM_ERROR, -28))
    device.close()
    check("closed", control.fake_hd_devices_open() == 0)
    print(f"the client and the fake agree: {checks} checks, {rate:.0f} calls a second at 1600 Hz")


def main(arguments: list[str]) -> int:
    """Prepares the environment, then runs this program in it."""
    if arguments == ["--drive"]:
        drive()
        return 0
    fake = Path(arguments[0] if arguments else FAKE).resolve()
    if not fake.exists():
        print(f"{fake} does not exist: build it first with ./test cpp", file=sys.stderr)
        return 1
    python = PLACE / "venv/bin/python"
    if not python.exists():
        venv.create(PLACE / "venv", with_pip=True)
    subprocess.run([python, "-m", "pip", "install", "-q", CLIENT], check=True)
    library = PLACE / "libHD.so"
    library.unlink(missing_ok=True)
    library.symlink_to(fake)
    environment = {**os.environ, "LD_LIBRARY_PATH": str(PLACE)}
    return subprocess.run([python, __file__, "--drive"], env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
