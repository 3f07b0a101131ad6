"""Builds and runs the C++ part of the measurements."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent


class ProgramError(RuntimeError):
    """The program could not be built, or its contestants disagree."""


def tool(name: str) -> str | None:
    """A program next to this Python, or else on PATH."""
    beside = Path(sys.executable).parent / name
    return str(beside) if beside.is_file() else shutil.which(name)


def build(folder: Path, target: str = "bench_ticks", source: Path = ROOT) -> Path:
    """Configures if needed and compiles. Returns the path of the program."""
    cmake, ninja = tool("cmake"), tool("ninja")
    if cmake is None:
        raise ProgramError("CMake is missing; run ./bench, which installs it")
    configure = [cmake, "-S", str(source), "-B", str(folder), "-DPUNCTURA_BENCH=ON", "-DCMAKE_BUILD_TYPE=None"]
    if ninja is not None:
        configure += ["-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={ninja}"]
    # Configure afresh after a change of the folder or compiler.
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
    """Runs the program, `seconds` for each row. It writes the depths and forces for the NumPy loop to `dump`."""
    done = subprocess.run(
        [str(program), "--seconds", str(seconds), "--dump", str(dump)], stdout=subprocess.PIPE, text=True
    )
    if done.returncode != 0:
        raise ProgramError(f"{program.name} ended with {done.returncode}; see its message above")
    result: dict[str, Any] = json.loads(done.stdout)
    return result
