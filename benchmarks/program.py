"""Builds the C++ part of the measurements, and runs it."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent


class ProgramError(RuntimeError):
    """The program could not be built, or its contestants did not agree."""


def tool(name: str) -> str | None:
    """A program beside this Python, or else on the path."""
    beside = Path(sys.executable).parent / name
    return str(beside) if beside.is_file() else shutil.which(name)


def build(folder: Path, target: str = "bench_ticks") -> Path:
    """Configures where needed and compiles; gives the path of the program."""
    cmake, ninja = tool("cmake"), tool("ninja")
    if cmake is None:
        raise ProgramError("no CMake found; ./bench brings one")
    configure = [cmake, "-S", str(ROOT), "-B", str(folder), "-DPUNCTURA_BENCH=ON", "-DCMAKE_BUILD_TYPE=None"]
    if ninja is not None:
        configure += ["-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={ninja}"]
    # What was configured for another place or compiler is laid anew.
    wanted, stamp = "\n".join([*configure, os.environ.get("CXX", "")]), folder / "configured-with"
    if not stamp.is_file() or stamp.read_text() != wanted:
        shutil.rmtree(folder, ignore_errors=True)
    for command in (configure, [cmake, "--build", str(folder), "--target", target]):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            raise ProgramError(f"{' '.join(command)}\n{done.stdout[-4000:]}")
    stamp.write_text(wanted)
    return folder / "benchmarks" / target


def call(program: Path, seconds: float, dump: Path) -> dict[str, Any]:
    """Runs it, `seconds` for each row; the depths and forces for the NumPy loop go to `dump`."""
    done = subprocess.run(
        [str(program), "--seconds", str(seconds), "--dump", str(dump)], stdout=subprocess.PIPE, text=True
    )
    if done.returncode != 0:
        raise ProgramError(f"{program.name} ended with {done.returncode}; its message stands above")
    result: dict[str, Any] = json.loads(done.stdout)
    return result
