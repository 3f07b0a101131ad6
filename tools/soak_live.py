"""Records the simulated device at 1600 Hz for minutes while another process keeps one core busy.

    python tools/soak_live.py --minutes 10

Passes if no snapshot is lost, ticks have no gap, 99.9 % of ticks are computed within 2 % of the period, and
a replay is identical.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from punctura import load_scene
from punctura._core import ServoLoop, SimulatedDevice
from punctura.live import strokes_through
from punctura.record import Recorder, Recording, open_recording, replay
from punctura.record.columns import numbers
from resident import resident_mb

RATE = 1600.0
MOST_COMPUTE = 0.02  # share of the period


def stolen_s() -> float:
    """Processor time that a virtual machine's host took since boot, s; NaN if the system does not report it."""
    try:
        return int(Path("/proc/stat").read_text().split()[8]) / os.sysconf("SC_CLK_TCK")
    except (OSError, ValueError, IndexError):
        return float("nan")


def gap_free(recording: Recording) -> bool:
    expected = 0
    for batch in recording.batches():
        tick = numbers(batch, "tick").astype(np.int64)
        if (tick != expected + np.arange(len(tick))).any():
            return False
        expected += len(tick)
    return expected == recording.rows


def soak(minutes: float, folder: Path) -> int:
    scene = load_scene("k06-fig12")
    device = SimulatedDevice(strokes_through(scene), rate=RATE, axis=scene.membranes[0].inward_normal)
    loop = ServoLoop(device, scene)
    path = folder / "soak.parquet"
    with Recorder(loop, path) as recorder:
        loop.arm()
        loop.start()
        began = time.monotonic()
        memory, shown, stolen = 0.0, began, stolen_s()
        while (now := time.monotonic()) - began < 60 * minutes:
            time.sleep(0.05)
            if int(loop.latest()["fault"][0]):  # reset the loop, like a user after a fault
                loop.reset()
                loop.arm()
            if memory == 0 and now - began > min(10.0, 30 * minutes):
                memory = resident_mb()
            if now - shown > 30:
                shown, status = now, recorder.status()
                print(f"{status.rows} ticks, {status.lost} lost, {status.bytes / 1e6:.0f} MB", flush=True)
        loop.stop()
        grown, stolen = resident_mb() - memory, stolen_s() - stolen
    status = recorder.status()
    report, recording = loop.report(), open_recording(path)
    compute, whole = report["compute"], gap_free(recording)
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    print(
        f"ticks made {report['ticks']}, recorded {recording.rows}, lost {recording.lost}, "
        f"gap-free {'yes' if whole else 'NO'}, skipped by the device {device.missed}, late {report['late']}"
    )
    print(
        f"compute: p50 {compute['p50'] * 1e6:.2f} us, p99.9 {compute['p99_9'] * 1e6:.2f} us "
        f"({compute['p99_9'] * RATE:.2%} of the period), largest {compute['largest'] * 1e6:.0f} us"
    )
    print(
        f"memory grew by {grown:.1f} MB; file {status.bytes / 1e6:.1f} MB; slowest write "
        f"{status.slowest_write_s * 1e3:.1f} ms; load {load:.1f} on {os.cpu_count()} cores; "
        f"the virtual machine's host took {stolen:.2f} s"
    )
    print(f"faults: {recording.summary['fault_count']}, each cleared by a reset")
    for fault in recording.faults[:5]:
        print(f"  at tick {fault['tick']}: {fault['meaning']}")
    again = replay(path)
    print(f"replay: {again.ticks} ticks, {'identical' if again.identical and again.complete else 'NOT IDENTICAL'}")
    for statement in device.statements():
        print(statement)
    good = (
        recording.lost == 0
        and recording.rows == report["ticks"]
        and whole
        and compute["p99_9"] * RATE < MOST_COMPUTE
        and not status.trouble
        and again.identical
        and again.complete
    )
    print("passed" if good else f"FAILED {status.trouble}")
    return 0 if good else 1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=10.0)
    minutes = parser.parse_args().minutes
    busy = subprocess.Popen([sys.executable, "-c", "while True: pass"])
    try:
        with tempfile.TemporaryDirectory() as folder:
            return soak(minutes, Path(folder))
    finally:
        busy.kill()
        busy.wait()


if __name__ == "__main__":
    sys.exit(main())
