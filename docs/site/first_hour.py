"""Runs the steps of docs/first-hour.md on simulated devices, and writes what they print into the page.

    chrt --fifo 10 python docs/site/first_hour.py [DEVICE ...]

It runs in real time: without chrt, other programs make ticks late. A run with a late tick is made again. It is an
error if a run has no force.

A step is a block of commands, a comment `<!-- DEVICE, STATE -->` and a block of text: what the commands print in a
terminal. The devices are those of tests/fakes, STATE is one of STATES.
"""

import asyncio
import ctypes
import json
import os
import pty
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import NamedTuple

from layout import ROOT

PAGE = ROOT / "docs" / "first-hour.md"
FAKES = ROOT / "tests" / "fakes"
# missing: no library or service. none: no device. raw: not calibrated. rest: held still. pressed: pushed 2 mm into the
# membrane, and back. Of the touch alone: pulled, the same, and the cable is pulled while it is pressed; strokes, pushed
# through, and back.
DEVICES = ("touch", "omega", "inverse3")
STATES = ("missing", "none", "raw", "rest", "pressed")
OF_TOUCH = ("pulled", "strokes")
LIBRARIES = {"touch": ("hd", "libHD.so"), "omega": ("drd", "libdrd.so.3")}
VARIABLES = {"touch": "PUNCTURA_HD_LIBRARY", "omega": "PUNCTURA_DRD_LIBRARY"}
ABOVE = 0.03  # m, of the omega's arm
WAYS = {"pressed": 0.022, "pulled": 0.022, "strokes": 0.03}  # m down; the membrane is 20 mm below
LATE = re.compile(r"a tick came too late|did not answer\s+within|finishing the recording")  # this computer was busy
STRONGEST = re.compile(r"strongest felt force ([\d.]+) N")
PULLED_S = 2.3  # after the hand begins to push; it is down after 2 s, for at least 0.6 s
COLUMNS = 112
STEP = re.compile(
    r"```(?P<language>sh|python) no-run: [^\n]*\n(?P<code>[^`]*)```\n<!-- (?P<device>\w+), (?P<state>\w+) -->\n"
    r"```text\n(?P<printed>.*?)```\n",
    re.S,
)


class Step(NamedTuple):
    language: str
    code: str
    device: str
    state: str
    printed: str


def steps(page: str) -> list[Step]:
    return [Step(*found.groups()) for found in STEP.finditer(page)]


def strongest_N(printed: str) -> float:
    """The strongest felt force of a run, 0 if there was no run."""
    found = STRONGEST.search(printed)
    return float(found[1]) if found else 0


def build(folder: Path) -> None:
    """The fakes under the names of the makers' libraries: from PUNCTURA_FAKES, where ./test has compiled them, or
    compiled here."""
    for fake, name in LIBRARIES.values():
        built = Path(os.environ.get("PUNCTURA_FAKES", folder), fake, f"fake_{fake}.so")
        if built.exists():
            shutil.copy(built, folder / name)
            continue
        flags = ["-std=c++20", "-O1", "-ffp-contract=off", "-fPIC", "-shared", "-fvisibility=hidden", "-Wl,-Bsymbolic"]
        paths = [f"-I{ROOT / part}" for part in ("core", "runtime", "tests")]
        sources = map(str, sorted((FAKES / fake).glob("*.cpp")))
        command = [os.environ.get("CXX", "c++"), *flags, *paths, "-pthread", "-o", str(folder / name), *sources]
        subprocess.run(command, check=True)


def run(step: Step, folder: Path) -> str:
    """What the terminal shows. `folder` has the libraries; files of earlier steps are in it."""
    work = folder / step.device
    (work / "bin").mkdir(parents=True, exist_ok=True)
    program = work / "bin" / "punctura"
    words = shlex.join([sys.executable, __file__, "as", step.device, step.state])
    program.write_text(f'#!/bin/sh\nexec {words} "$@"\n')
    program.chmod(0o755)
    environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}", "TERM": "dumb", "NO_COLOR": "1"}
    environment |= {"COLUMNS": str(COLUMNS), "HOME": str(work)}
    if step.device in LIBRARIES and step.state != "missing":
        environment[VARIABLES[step.device]] = os.path.relpath(folder / LIBRARIES[step.device][1], work)
    if step.language == "sh":
        for old in work.glob("*.parquet"):
            old.unlink()
    shell = ["bash", "-c"] if step.language == "sh" else [sys.executable, "-c"]
    served = step.device == "inverse3" and step.state != "missing"
    service = (
        subprocess.Popen([sys.executable, __file__, "serve", step.state], stdout=subprocess.PIPE) if served else None
    )
    try:
        if service and service.stdout:
            service.stdout.readline()
        return shown(in_terminal([*shell, step.code], environment, work))
    finally:
        if service:
            service.kill()
            service.wait()


def in_terminal(command: list[str], environment: dict[str, str], folder: Path) -> str:
    """Runs a command in a terminal, and presses Enter where it asks for that."""
    own, its = pty.openpty()
    program = subprocess.Popen(command, stdin=its, stdout=its, stderr=its, env=environment, cwd=folder)
    os.close(its)
    text = ""
    while True:
        try:
            piece = os.read(own, 65536)
        except OSError:  # EIO: the other end is closed
            break
        text += piece.decode()
        if text.endswith("press Enter "):
            os.write(own, b"\n")
    os.close(own)
    program.wait()
    return text


def shown(text: str) -> str:
    """Lines as on the screen, wrapped. Of a line that was rewritten in place, the one with the strongest force."""
    lines: list[str] = []
    for line in text.replace("\r\n", "\n").split("\n"):
        states = [part.rstrip() for part in line.split("\r") if part.strip()]
        forces = [abs(float(found[1])) for part in states if (found := re.search(r"force \S+ ([+-][\d.]+) ", part))]
        lines += [states[forces.index(max(forces))]] if forces else []
        lines += states[len(forces) :][-1:]
    return "".join(
        textwrap.fill(line, COLUMNS, subsequent_indent="    ", break_long_words=False) + "\n" for line in lines
    )


def act(device: str, state: str) -> None:
    """Puts the fake in this process into a state."""
    if device in LIBRARIES and state != "missing":
        library = ctypes.CDLL(os.environ[VARIABLES[device]])
        (touch if device == "touch" else omega)(library, state)


def touch(library: ctypes.CDLL, state: str) -> None:
    class Settings(ctypes.Structure):
        """fake_hd_settings, tests/fakes/hd/fake_hd.h."""

        _fields_ = (
            ("name", ctypes.c_char_p), ("null_opens", ctypes.c_int), ("init_error", ctypes.c_uint),
            ("only_rate", ctypes.c_ulong), ("rate_error", ctypes.c_uint), ("real_rate", ctypes.c_double),
            ("fast_ticks", ctypes.c_ulonglong), ("ideal", ctypes.c_int), ("from_mm", ctypes.c_double * 3),
            ("to_mm", ctypes.c_double * 3), ("duration", ctypes.c_double), ("seed", ctypes.c_ulonglong),
            ("axis", ctypes.c_double * 3), ("stretch", ctypes.c_double), ("buttons", ctypes.c_int),
            ("temperature", ctypes.c_double), ("calibration", ctypes.c_uint), ("style", ctypes.c_uint),
            ("renewing_works", ctypes.c_int),
        )  # fmt: skip

    s = Settings()
    library.fake_hd_defaults(ctypes.byref(s))
    s.from_mm[:] = s.to_mm[:] = (0.0, -40.0, -60.0)
    s.duration = 2.0
    s.to_mm[1] -= 1e3 * WAYS.get(state, 0)
    if state == "none":
        s.init_error = 0x302  # COMM_ERROR
    if state == "raw":
        s.calibration = 0x5002  # NEEDS_MANUAL_INPUT
    library.fake_hd_reset(ctypes.byref(s))
    if state == "pulled":
        unplug, ever = 3, 1 << 60
        arguments = (ctypes.c_int(unplug), ctypes.c_uint(0), ctypes.c_ulonglong(int((0.6 + PULLED_S) * 1600)))
        library.fake_hd_inject(*arguments, ctypes.c_ulonglong(ever))


def omega(library: ctypes.CDLL, state: str) -> None:
    class Settings(ctypes.Structure):
        """The first fields of fake_drd::Settings, tests/fakes/drd/fake_drd.hpp, and their neutral values."""

        _fields_ = tuple((name, ctypes.c_int) for name in (
            "devices", "in_use", "system_type", "wrist", "calibrated", "starts_forces", "repeat_every", "old_cause",
        )) + tuple((name, ctypes.c_double) for name in (
            "user_max_force", "motor_force", "brake_speed", "watchdog", "f00", "f01", "f02", "f10", "f11", "f12", "f20",
            "f21", "f22", "encoder_step", "friction", "tremor", "transfer",
        ))  # fmt: skip

    class Strokes(ctypes.Structure):
        _fields_ = (
            ("start", ctypes.c_double * 3), ("end", ctypes.c_double * 3), ("count", ctypes.c_int),
            *((name, ctypes.c_double) for name in ("duration", "rest", "variation")), ("seed", ctypes.c_uint64),
        )  # fmt: skip

    frame = (1, 0, 0, 0, 1, 0, 0, 0, 1)
    known = (int(state != "none"), 0, 33, 0, int(state != "raw"), 1, 0, 0)
    settings = Settings(*known, -1, 12, 1e9, 0.01, *frame, 0.055e-3, 0.26, 3e-5, 0)
    library.fake_drd_reset(ctypes.byref(settings))
    above = (0.0, 0.0, ABOVE)
    library.fake_drd_target(*(ctypes.c_double(value) for value in above))

    def during_the_run() -> None:
        report = (ctypes.c_int64 * 32)()  # fake_drd::Report: the number of readings is its thirteenth
        while report[12] < 1000:  # opening reads some 50 times
            time.sleep(0.01)
            library.fake_drd_report(report)
        if state in WAYS:
            below = (0.0, 0.0, ABOVE - WAYS[state])
            library.fake_drd_strokes(ctypes.byref(Strokes(above, below, 1, 2, 1, 0, 1)))

    threading.Thread(target=during_the_run, daemon=True).start()


def serve(state: str) -> None:
    """An Inverse Service at the usual port."""
    sys.path.insert(0, str(FAKES))
    from inverse_service import InverseService

    class Service(InverseService):
        def state(self, config: bool = False) -> str:
            whole = json.loads(super().state(config))
            for arm in whole["inverse3"]:
                arm["status"]["calibrated"] = state != "raw"
            return json.dumps(whole)

    async def forever() -> None:
        service = Service(removed=state == "none")
        server = await service.start(10001)
        print("ready", flush=True)
        above, begin = service.arm.hand[2], 0.0
        while server.is_serving():
            await asyncio.sleep(0.005)
            begin = begin or (time.monotonic() if service.messages else 0.0)
            since = time.monotonic() - begin - 2 if begin else 0.0  # opening takes less
            down = max(0.0, min(since, 5 - since, 2) / 2)
            service.arm.hand[2] = above - WAYS.get(state, 0) * down

    asyncio.run(forever())


def blocks(devices: Collection[str]) -> Iterator[str]:
    """The page, with what each step of these devices prints now."""
    page, done = PAGE.read_text(encoding="utf-8"), 0
    with tempfile.TemporaryDirectory() as name:
        build(Path(name))
        for found in STEP.finditer(page):
            if found["device"] not in devices:
                continue
            print(f"{found['device']}, {found['state']}: {found['code'].strip()}", file=sys.stderr)
            step = Step(*found.groups())
            tries = (run(step, Path(name)) for _ in range(5))
            printed = next((text for text in tries if not LATE.search(text)), "")
            if not printed or (step.code.startswith("punctura run") and not strongest_N(printed)):
                raise SystemExit(f"no force, or a late tick in each of 5 runs:\n{printed}")
            yield page[done : found.start("printed")] + printed
            done = found.end("printed")
    yield page[done:]


if __name__ == "__main__":
    if sys.argv[1:2] == ["serve"]:
        serve(sys.argv[2])
    elif sys.argv[1:2] == ["as"]:
        from punctura.cli import main

        act(sys.argv[2], sys.argv[3])
        sys.argv = ["punctura", *sys.argv[4:]]
        main()
    else:
        PAGE.write_text("".join(blocks(sys.argv[1:] or DEVICES)), encoding="utf-8")
