"""Kills recording processes at random moments. The remaining file must open and lack at most the last 0.5 s.

    python tools/soak_recorder.py --kills 1000

All processes use the same file name. Half of them are killed at the start, before the file has a header or a tick; this
must not block the name for the next process. A quarter is killed while recording, a quarter while finishing the file. A
process reports its present tick through shared memory.
"""

import argparse
import mmap
import os
import random
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
from punctura import load_scene
from punctura._core import ServoLoop, SimulatedDevice
from punctura.live import strokes_through
from punctura.record import Recorder, RecordingError, open_recording
from punctura.record.header import build_id
from waiting import wait_until

RATE = 1600.0
MOST_MISSING_S = 0.5
# For each kind of kill, its longest delay, s, after: the start of the process (kinds 0 and 1), the creation of the
# recorder, the call of finish.
KILLED_WITHIN_S = (0.03, 0.2, 0.8, 0.1)
MOST_WAIT_S = 60.0
TICKS, FINISHING, STATE = 0, 8, 16  # places in the shared memory
BEGUN, BLOCKED = 1, 2  # states


class Kill(NamedTuple):
    """The result of one kill."""

    ticks: int
    missing_s: float
    blocked: bool
    began: bool  # whether the recorder existed at the kill


def record(path: Path, shared: mmap.mmap, finish_after_s: float) -> None:
    """Records in the process that will be killed."""
    scene = load_scene("k06-fig12")
    device = SimulatedDevice(strokes_through(scene), rate=RATE, axis=scene.membranes[0].inward_normal)
    loop = ServoLoop(device, scene)
    try:
        recorder = Recorder(loop, path)
    except RecordingError as bad:
        print(bad, file=sys.stderr, flush=True)
        struct.pack_into("<q", shared, STATE, BLOCKED)
        return
    struct.pack_into("<q", shared, STATE, BEGUN)
    loop.arm()
    loop.start()
    began = time.monotonic()
    while time.monotonic() - began < finish_after_s:
        struct.pack_into("<q", shared, TICKS, loop.report()["ticks"])
        time.sleep(2e-3)
    loop.stop()
    struct.pack_into("<q", shared, TICKS, loop.report()["ticks"])
    struct.pack_into("<q", shared, FINISHING, 1)
    recorder.finish()
    time.sleep(MOST_WAIT_S)


def serve() -> int:
    """A process with all imports done. It forks a recording process for each input line, so that a start is fast."""
    build_id()
    for line in sys.stdin:
        path, memory, finish_after = line.rstrip("\n").split("\t")
        child = os.fork()
        if child == 0:
            with Path(memory).open("r+b") as file, mmap.mmap(file.fileno(), 24) as shared:
                record(Path(path), shared, float(finish_after))
            os._exit(0)
        sys.stdin.readline()
        os.kill(child, signal.SIGKILL)  # safe even if it has ended: its id is not reused before it is waited for
        os.waitpid(child, 0)
        print("over", flush=True)
    return 0


class Server:
    """Starts the processes to kill, one after the other."""

    def __init__(self) -> None:
        self._process = subprocess.Popen(
            [sys.executable, __file__, "--serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def start(self, *words: object) -> None:
        self._ask(*words)

    def kill(self) -> None:
        """Kills the last started process."""
        self._ask("kill")
        assert self._process.stdout and self._process.stdout.readline() == "over\n"

    def _ask(self, *words: object) -> None:
        assert self._process.stdin
        print(*words, sep="\t", file=self._process.stdin, flush=True)

    def close(self) -> None:
        assert self._process.stdin
        self._process.stdin.close()
        self._process.wait()


def kill_once(server: Server, folder: Path, chance: random.Random, kind: int) -> Kill:
    """Starts and kills a process. kind: 0, 1 at its start; 2 recording; 3 finishing. Raises AssertionError."""
    path, memory = folder / "run.parquet", folder.with_name(folder.name + "-tick")
    memory.write_bytes(bytes(24))
    finish_after = chance.uniform(0.05, 0.5) if kind == 3 else 2 * MOST_WAIT_S
    with memory.open("r+b") as file, mmap.mmap(file.fileno(), 24) as shared:

        def word_at(place: int) -> int:
            return int(struct.unpack_from("<q", shared, place)[0])

        server.start(path, memory, finish_after)
        try:
            begun = FINISHING if kind == 3 else STATE
            wait_until(lambda: kind < 2 or word_at(STATE) == BLOCKED or word_at(begun) != 0, MOST_WAIT_S, poll=1e-4)
            time.sleep(chance.uniform(0, KILLED_WITHIN_S[kind]))
        finally:
            server.kill()
        ticks, state = word_at(TICKS), word_at(STATE)
    return Kill(ticks, missing_at_end(path, ticks), state == BLOCKED, state == BEGUN)


def missing_at_end(path: Path, ticks: int) -> float:
    """Time from the last tick in the file to the last tick made, s. Removes a file with ticks, like a user would."""
    rows = 0
    part = path.with_name(path.name + ".part")
    if path.exists() or (part.exists() and part.stat().st_size):
        recording = open_recording(path)
        tick = recording.column("tick").astype(np.int64)
        rows = len(tick)
        assert recording.lost == 0, f"{recording.lost} ticks lost"
        assert (tick == np.arange(rows)).all(), "the ticks have gaps"
        if rows:
            path.unlink(missing_ok=True)
            part.unlink(missing_ok=True)
    missing = max(0, ticks - rows) / RATE
    assert missing <= MOST_MISSING_S, f"the last {missing:.3f} s are missing"
    return missing


def clear(folder: Path) -> None:
    for file in folder.iterdir():
        file.unlink()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", help="folder for the recordings; default: the folder for temporary files")
    parser.add_argument("--serve", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.serve:
        return serve()

    chance, server = random.Random(arguments.seed), Server()
    kills, failed = [], 0
    with tempfile.TemporaryDirectory(dir=arguments.folder) as top:
        folder = Path(top) / "recordings"
        folder.mkdir()
        for i in range(arguments.kills):
            try:
                kills.append(kill_once(server, folder, chance, i % 4))
            except (AssertionError, ValueError) as bad:
                failed += 1
                print(f"kill {i + 1}: FAILED: {bad}", flush=True)
                clear(folder)
                continue
            if kills[-1].blocked:
                print(f"kill {i + 1}: the name was blocked", flush=True)
                clear(folder)
        server.close()
        left = sorted(file.name for file in folder.iterdir())
    missing = [kill.missing_s for kill in kills] or [0.0]
    blocked = sum(kill.blocked for kill in kills)
    early = sum(not kill.began for kill in kills)
    print(f"missing at the end: median {np.median(missing):.3f} s, maximum {max(missing):.3f} s")
    print(f"{early} killed before their recorder existed; files left in the folder: {', '.join(left) or 'none'}")
    print(f"{arguments.kills} kills, {failed} failed, {blocked} names blocked")
    return 1 if failed or blocked else 0


if __name__ == "__main__":
    sys.exit(main())
