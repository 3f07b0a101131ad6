"""Fuzzes the reader of recordings with truncated files, flipped bits, and invalid descriptions with a right checksum.

Fails on a crash, a hang, growing memory, an error other than RecordingError, or a wrong number.

python tools/fuzz_recordings.py --minutes 10
"""

import argparse
import faulthandler
import json
import random
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pyarrow as pa
from punctura import load_scene
from punctura._core import ServoLoop, SimulatedDevice
from punctura.record import Recorder, RecordingError, export, open_recording, replay, replay_device
from punctura.simulation import Strokes
from punctura.studio.recorded import overview
from punctura.studio.shelf import entry_of
from spoil_recording import description_of, rewrite, spoil_description
from waiting import wait_until

HANG_S = 30
MOST_GROWTH_MB = 100.0
SCENE, WIDER = "k06-fig10", "k06-fig12"  # one membrane, then two: a file of two streams


def originals(folder: Path) -> list[Path]:
    """One recording, unfinished and finished."""
    device = SimulatedDevice(Strokes((0, 5e-3, 0), (0, -0.02, 0), duration=0.2), real_time=False, ticks=1500)
    loop = ServoLoop(device, load_scene(SCENE))
    path, kept = folder / "whole.parquet", folder / "growing.part"
    recorder = Recorder(loop, path, capacity=2048)
    recorder.exchange(load_scene(WIDER))
    loop.arm()
    loop.start()
    wait_until(lambda: recorder.status().rows >= 1500)
    loop.stop()
    shutil.copy(recorder.status().file, kept)
    status = recorder.finish()
    assert status.finished, status.trouble
    return [kept, path]


def spoil(data: bytes, chance: random.Random) -> bytes:
    spoilt = bytearray(data)
    for _ in range(chance.choice([0, 1, 1, 1, 2, 8])):
        # The ends hold the metadata, so half of the flips go there.
        place = chance.randrange(len(spoilt)) if chance.random() < 0.5 else _near_an_end(len(spoilt), chance)
        spoilt[place] ^= 1 << chance.randrange(8)
    kind = chance.randrange(6)
    if kind == 0:
        del spoilt[chance.randrange(len(spoilt)) :]
    elif kind == 1:
        start = chance.randrange(len(spoilt))
        spoilt[start : start + chance.randrange(1, 4096)] = bytes(chance.randrange(1, 4096))
    elif kind == 2:
        start = chance.randrange(len(spoilt))
        spoilt[start:start] = spoilt[start : start + chance.randrange(1, 4096)]
    return bytes(spoilt)


def _near_an_end(size: int, chance: random.Random) -> int:
    reach = min(size, 8192)
    return chance.randrange(reach) if chance.random() < 0.5 else size - 1 - chance.randrange(reach)


def read_all(path: Path, whole: pa.Table) -> int:
    """Number of readable ticks. Raises AssertionError if one differs from the original."""
    try:
        recording = open_recording(path)
        names = [name for name in recording.schema.names if name in whole.schema.names]
        rows = 0
        for batch in recording.batches():
            rows += len(batch)
            if len(batch):
                first = batch.column("tick")[0].as_py()
                wanted = whole.slice(first, len(batch)).select(names)
                given = pa.Table.from_batches([batch]).select(names)
                assert bits(given) == bits(wanted), f"ticks from {first} on differ from the original"
        return rows
    except RecordingError:
        return 0


def bits(table: pa.Table) -> list[Any]:
    """The columns, numbers as their bits: NaN equals NaN."""
    return [
        column.combine_chunks().view(pa.uint64()) if column.type == pa.float64() else column.to_pylist()
        for column in table.columns
    ]


def use_all(path: Path) -> None:
    """Runs all operations on a recording. Raises AssertionError for an error other than RecordingError."""
    uses = (
        lambda: json.dumps(asdict(entry_of("case", open_recording(path))), allow_nan=False).encode(),
        lambda: json.dumps(overview(open_recording(path)).model_dump(mode="json"), allow_nan=False).encode(),
        lambda: replay(path),
        lambda: replay_device(path),
        lambda: export(path, path.with_suffix(".csv")),
        lambda: export(path, path.with_suffix(".mcap")),
    )
    for use in uses:
        try:
            use()
        except RecordingError as bad:
            assert str(path) in str(bad), f"does not name its file: {bad}"


def memory_mb() -> float:
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def fuzz(seconds: float, seed: int, folder: Path) -> None:
    """Runs in the process that may crash. Prints each case before running it."""
    files = originals(folder)
    contents = [file.read_bytes() for file in files]
    described = [description_of(file) for file in files]
    whole = open_recording(files[1]).table()
    assert [read_all(file, whole) for file in files] == [1500, 1500]
    case = folder / "case.parquet"
    began, count, memory = time.monotonic(), 0, 0.0
    while time.monotonic() - began < seconds:
        chance = random.Random(seed * 1_000_003 + count)
        wrong = count % 4 >= 2  # alternately two cases of each kind
        if wrong:
            rewrite(files[count % 2], case, spoil_description(described[count % 2], chance))
        else:
            case.write_bytes(spoil(contents[count % 2], chance))
        print(f"case {count} of seed {seed}", file=sys.stderr, flush=True)
        faulthandler.dump_traceback_later(HANG_S, exit=True)
        read_all(case, whole)
        if wrong:
            use_all(case)
        faulthandler.cancel_dump_traceback_later()
        count += 1
        if count == 200:
            memory = memory_mb()
    grown = memory_mb() - memory if memory else 0.0
    assert grown < MOST_GROWTH_MB, f"memory grew by {grown:.0f} MB"
    print(f"{count} broken files: no crash, no hang, no wrong number; memory grew by {grown:.1f} MB")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--here", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.here:
        fuzz(60 * arguments.minutes, arguments.seed, Path(arguments.here))
        return 0
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, __file__, "--here", folder, "--seed", str(arguments.seed)]
        done = subprocess.run([*command, "--minutes", str(arguments.minutes)], capture_output=True, text=True)
        print(done.stdout, end="")
        if done.returncode:
            kept = Path(tempfile.gettempdir()) / f"punctura-fuzz-{arguments.seed}.parquet"
            if (Path(folder) / "case.parquet").exists():
                shutil.copy(Path(folder) / "case.parquet", kept)
            print(
                "\n".join(done.stderr.splitlines()[-30:]),
                f"FAILED with status {done.returncode}; the file is {kept}",
                sep="\n",
            )
        return 1 if done.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
