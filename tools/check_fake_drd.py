"""Checks the fake Force Dimension library with an independent public client. This tests the fake, not Punctura.

python tools/check_fake_drd.py [FAKE_LIBRARY]     after ./test cpp

Installs forcedimension-core (LGPL-3) from PyPI into build/fake-drd-check. On import, it binds every function of the
maker's library. For functions that the fake lacks, this program generates stubs that fail, with the names from the
client's sources.
"""

from __future__ import annotations

import ctypes
import math
import os
import platform
import re
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PLACE = ROOT / "build" / "fake-drd-check"
FAKE = ROOT / "build/dev/tests/runtime/fakes/drd/fake_drd.so"
CLIENT = "forcedimension-core==1.0.0"


class Settings(ctypes.Structure):
    """punctura::fake_drd::Settings, tests/fakes/drd/fake_drd.hpp."""

    _fields_ = (
        *((name, ctypes.c_int) for name in ("devices", "in_use", "system_type", "wrist", "calibrated")),
        *((name, ctypes.c_int) for name in ("starts_forces", "repeat_every", "old_force_off_cause")),
        *((name, ctypes.c_double) for name in ("user_max_force", "motor_force", "brake_speed", "watchdog")),
        ("frame", ctypes.c_double * 9),
        *((name, ctypes.c_double) for name in ("encoder_step", "friction", "tremor", "transfer")),
    )


def prepare(fake: Path) -> tuple[Path, Path]:
    """Makes a virtual environment with the client, and a folder laid out like the SDK. Returns Python and folder."""
    python = PLACE / "venv/bin/python"
    if not python.exists():
        venv.create(PLACE / "venv", with_pip=True)
    subprocess.run([python, "-m", "pip", "install", "-q", CLIENT], check=True)
    sources = next((PLACE / "venv/lib").glob("python*/site-packages/forcedimension_core"))
    text = "".join(path.read_text(encoding="utf-8") for path in sources.rglob("*.py"))
    wanted = set(re.findall(r"_lib(?:dhd|drd)\.((?:dhd|drd)[A-Z]\w*)", text))
    library = ctypes.CDLL(str(fake))
    lacking = sorted(name for name in wanted if not hasattr(library, name))
    folder = PLACE / f"sdk/lib/release/lin-{platform.machine()}-gcc"
    folder.mkdir(parents=True, exist_ok=True)
    stubs = PLACE / "stubs.c"
    stubs.write_text("".join(f"int {name}(void) {{ return -1; }}\n" for name in lacking), encoding="utf-8")
    compiler = os.environ.get("CC", "cc")
    linked = ["-o", folder / "libdrd.so.3.17.5", stubs, "-Wl,--no-as-needed", fake]
    subprocess.run([compiler, "-shared", "-fPIC", "-fno-builtin", *linked], check=True)
    print(f"{CLIENT}: {len(wanted)} functions wanted, {len(wanted) - len(lacking)} of them the fake's own")
    return python, PLACE / "sdk"


def drive(fake: Path) -> None:
    """Runs in the client's environment. Checks each rule of the library that the back-end relies on."""
    from forcedimension_core import containers, dhd, drd  # type: ignore[import-not-found]
    from forcedimension_core.constants import DeviceType, ErrorNum, ForceOffCause  # type: ignore[import-not-found]

    control = ctypes.CDLL(str(fake))
    control.fake_drd_target.argtypes = [ctypes.c_double] * 3
    control.fake_drd_inject.argtypes = [ctypes.c_int, ctypes.c_int64]
    control.fake_drd_now.restype = ctypes.c_int64
    control.fake_drd_advance.argtypes = [ctypes.c_int64]
    frame = (ctypes.c_double * 9)(0, 0, -1, 0, 1, 0, 1, 0, 0)
    settings = Settings(1, 0, 34, 1, 1, 1, 4, 0, -1, 3.3, 1e9, 0.01, frame, 0.055e-3, 0.26, 3e-5)
    unplug = 0
    checks = 0

    def check(what: str, holds: bool) -> None:
        nonlocal checks
        checks += 1
        if not holds:
            sys.exit(f"the client and the fake disagree: {what}")

    def later(milliseconds: float) -> None:
        control.fake_drd_advance(control.fake_drd_now() + int(milliseconds * 1e6))

    control.fake_drd_reset(ctypes.byref(settings))
    control.fake_drd_virtual_time(1)
    check("version", dhd.os_independent is not None and dhd.getSDKVersion()[:3] == (3, 17, 5))
    check("one device, free", (dhd.getDeviceCount(), dhd.getAvailableCount()) == (1, 1))
    check("nothing is open yet", dhd.getPosition(containers.Vec3()) == -1)
    number = dhd.openID(0)
    check("open", number >= 0)
    check("type and name", dhd.getSystemType() == DeviceType.OMEGA6_RIGHT and dhd.getSystemName() == "omega.6")
    check("serial number", dhd.getSerialNumber(number) == 12345)
    check(
        "bools in the low byte", dhd.hasWrist() is True and dhd.isLeftHanded() is False and drd.isInitialized() is True
    )
    check("no device has that number", dhd.getButtonMask(number + 1) == 0 and dhd.enableForce(True, number + 1) == -1)

    position, matrix, status = containers.Vec3(), [[0.0] * 3 for _ in range(3)], containers.Status()
    control.fake_drd_target(0.01, 0.02, 0.03)
    later(500)
    returned = [dhd.getPositionAndOrientationFrame(position, matrix) for _ in range(8)]
    check("0 for new samples, 1 for repeated ones", sorted(set(returned)) == [0, 1] and returned.count(1) == 2)
    check("position, in m", all(abs(a - b) < 1.5e-3 for a, b in zip(position, (0.01, 0.02, 0.03), strict=True)))
    check("rows of the frame", matrix == [[0, 0, -1], [0, 1, 0], [1, 0, 0]])

    check("force on", dhd.enableForce(True) == 0 and dhd.getStatus(status) == 0 and status.force == 1)
    check("force taken", dhd.setForceAndTorqueAndGripperForce((0, 0, 1), (0, 0, 0), 0) == 0)
    check("2 for saturated motors", dhd.setForce((0, 0, 5)) == 2)
    before = position[2]
    for _ in range(40):
        dhd.setForce((0, 0, 1))
        later(5)
    check("a force up moves the hand up", dhd.getPosition(position) >= 0 and position[2] > before + 1e-3)
    later(50)
    dhd.getStatus(status)
    check("its watchdog", (status.force, status.brake, status.forceoffcause) == (0, 1, ForceOffCause.WATCHDOG))
    control.fake_drd_buttons(5)
    check("buttons", dhd.getButtonMask() == 5 and [dhd.getButton(i) for i in range(3)] == [1, 0, 1])
    check("no limit set by its user", dhd.getMaxForce() == -1 and math.isfinite(dhd.getComFreq()))

    control.fake_drd_inject(unplug, control.fake_drd_now())
    later(1)
    check("unplugged", dhd.getPosition(position) == -1 and dhd.errorGetLast() == ErrorNum.COM)
    print(f"the client and the fake agree: {checks} checks")


def main(arguments: list[str]) -> int:
    """Prepares the environment, then runs this program in it."""
    if arguments[:1] == ["--drive"]:
        drive(Path(arguments[1]))
        return 0
    fake = Path(arguments[0] if arguments else FAKE).resolve()
    if not fake.exists():
        print(f"{fake} does not exist: build it first with ./test cpp", file=sys.stderr)
        return 1
    python, sdk = prepare(fake)
    environment = {**os.environ, "FDSDK": str(sdk)}
    return subprocess.run([python, __file__, "--drive", fake], env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
