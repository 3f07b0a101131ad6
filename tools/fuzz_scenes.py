"""Fuzzes the reader of scene files. Each file must give a Scene or a list of problems, in time and in flat memory.

    python tools/fuzz_scenes.py --seconds 600
    python tools/fuzz_scenes.py --seed 1 --case 17 > scene.toml    # the file of one case

Each resulting Scene is written and read again, and must be identical to the last bit.
"""

import argparse
import faulthandler
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from punctura import ConfigurationError, load_scene
from punctura.scene import scene_text
from resident import resident_mb
from spoil_scene import spoilt

HANG_S = 10.0
MOST_GROWTH_MB = 50.0
WARM_UP = 2000  # cases before the memory measurement starts
OF_THE_WHOLE_FILE = ("is larger than",)  # reasons without a place in the file


class Tally(NamedTuple):
    """The results of the cases."""

    cases: int
    scenes: int
    slowest_s: float
    slowest_case: int
    grown_mb: float

    def __str__(self) -> str:
        return (
            f"{self.cases} files: {self.scenes} scenes, {self.cases - self.scenes} rejected with reasons; "
            f"slowest {self.slowest_s:.2f} s (case {self.slowest_case}); memory grew by {self.grown_mb:.1f} MB"
        )


def judge(path: Path) -> bool:
    """Whether the file is a scene. Raises AssertionError or the reader's unexpected exception on a failure."""
    try:
        scene = load_scene(path)
    except ConfigurationError as bad:
        assert bad.problems and str(bad), "rejected without a problem"
        for problem in bad.problems:
            assert isinstance(problem.path, str) and isinstance(problem.reason, str)
            assert problem.reason.strip(), f"no reason: {problem}"
            assert problem.path or problem.reason.startswith(OF_THE_WHOLE_FILE), f"no path: {problem}"
            assert "\n" not in str(problem), f"not one line: {problem}"
        return False
    path.write_text(scene_text(scene), encoding="utf-8")
    assert load_scene(path) == scene, "the scene differs after writing and reading it again"
    return True


def case_bytes(seed: int, case: int) -> bytes:
    return spoilt(random.Random(seed * 1_000_003 + case))


def fuzz(folder: Path, seed: int, seconds: float = float("inf"), cases: int = sys.maxsize) -> Tally:
    """Runs in the process that may fail. Keeps the file of the present case in `folder`."""
    file, number = folder / "case.toml", folder / "case"
    scenes, slowest, grown, began = 0, (0.0, 0), 0.0, time.monotonic()
    memory, count = resident_mb(), 0
    while count < cases and time.monotonic() - began < seconds:
        file.write_bytes(case_bytes(seed, count))
        number.write_text(str(count))
        start = time.perf_counter()
        faulthandler.dump_traceback_later(HANG_S, exit=True)
        scenes += judge(file)
        faulthandler.cancel_dump_traceback_later()
        slowest = max(slowest, (time.perf_counter() - start, count))
        count += 1
        if count == WARM_UP:
            memory = resident_mb()
    grown = resident_mb() - memory
    assert not grown >= MOST_GROWTH_MB, f"memory grew by {grown:.0f} MB"
    return Tally(count, scenes, *slowest, grown)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--case", type=int, help="only print the file of this case")
    parser.add_argument("--here", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.case is not None:
        sys.stdout.buffer.write(case_bytes(arguments.seed, arguments.case))
        return 0
    if arguments.here:
        print(fuzz(Path(arguments.here), arguments.seed, arguments.seconds))
        return 0
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, __file__, "--here", folder, "--seed", str(arguments.seed)]
        done = subprocess.run([*command, "--seconds", str(arguments.seconds)], capture_output=True, text=True)
        print(done.stdout, end="")
        if done.returncode:
            case = (Path(folder) / "case").read_text() if (Path(folder) / "case").exists() else "none"
            print("\n".join(done.stderr.splitlines()[-40:]))
            print(f"FAILED with status {done.returncode} at case {case} of seed {arguments.seed}")
        return 1 if done.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
