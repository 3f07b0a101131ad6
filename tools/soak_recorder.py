"""Kills a recording process at random moments; what it has left must open, and lack at most the last half second.

    python tools/soak_recorder.py --kills 200

One in four is killed while it finishes its file. The process shares the tick that it is at through a file in memory.
"""

from __future__ import annotations

import argparse
import mmap
import random
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from punctura import load_scene
from punctura._core import ServoLoop, SimulatedDevice
from punctura.live import strokes_through
from punctura.record import Recorder, Recording, open_recording

RATE = 1600.0
MOST_MISSING_S = 0.5
LONGEST_RUN_S = 2.0


def record(path: Path, shared: mmap.mmap, finish_after_s: float) -> None:
    """The process that will be killed."""
    scene = load_scene("k06-fig12")
    device = SimulatedDevice(strokes_through(scene), rate=RATE, axis=scene.membranes[0].inward_normal)
    loop = ServoLoop(device, scene)
    recorder = Recorder(loop, path)
    loop.arm()
    loop.start()
    began = time.monotonic()
    while time.monotonic() - began < finish_after_s:
        struct.pack_into("<q", shared, 0, loop.report()["ticks"])
        time.sleep(2e-3)
    loop.stop()
    struct.pack_into("<q", shared, 0, loop.report()["ticks"])
    struct.pack_into("<q", shared, 8, 1)
    recorder.finish()
    time.sleep(60)


def kill_once(folder: Path, chance: random.Random, finishing: bool) -> tuple[float, int]:
    """Gives how much of the end is missing (s) and how many ticks there were. Raises AssertionError."""
    path, memory = folder / "run.parquet", folder / "tick"
    memory.write_bytes(bytes(16))
    finish_after = chance.uniform(0.2, 1.0) if finishing else 3600.0
    with memory.open("r+b") as file, mmap.mmap(file.fileno(), 16) as shared:
        command = [sys.executable, __file__, "--record", str(path), str(memory), str(finish_after)]
        process = subprocess.Popen(command)
        wanted = 8 if finishing else 0
        while struct.unpack_from("<q", shared, wanted)[0] == 0:
            assert process.poll() is None, "the recording process ended by itself"
            time.sleep(1e-3)
        time.sleep(chance.uniform(0, 0.2 if finishing else LONGEST_RUN_S))
        process.kill()
        process.wait()
        ticks = struct.unpack_from("<q", shared, 0)[0]
    recording = open_recording(path)
    return check(recording, ticks), ticks


def check(recording: Recording, ticks: int) -> float:
    """s between the last tick in the file and the last that the process said it had made."""
    tick = recording.column("tick").astype(np.int64)
    assert recording.lost == 0, f"{recording.lost} ticks lost"
    assert (tick == np.arange(len(tick))).all(), "the ticks have gaps"
    missing = max(0, ticks - len(tick)) / RATE
    assert missing <= MOST_MISSING_S, f"{missing:.3f} s are missing at the end"
    return missing


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--record", nargs=3, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.record:
        path, memory, finish_after = arguments.record
        with Path(memory).open("r+b") as file, mmap.mmap(file.fileno(), 16) as shared:
            record(Path(path), shared, float(finish_after))
        return 0

    chance = random.Random(arguments.seed)
    missing, failed = [], 0
    for i in range(arguments.kills):
        with tempfile.TemporaryDirectory() as folder:
            try:
                gone, ticks = kill_once(Path(folder), chance, finishing=i % 4 == 3)
                missing.append(gone)
                print(f"kill {i + 1}: {ticks} ticks, {gone * 1e3:.0f} ms missing", flush=True)
            except (AssertionError, ValueError) as bad:
                failed += 1
                print(f"kill {i + 1}: FAILED: {bad}", flush=True)
    if missing:
        print(f"missing at the end: {np.median(missing):.3f} s in the middle, {max(missing):.3f} s at most")
    print(f"{arguments.kills} kills, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
