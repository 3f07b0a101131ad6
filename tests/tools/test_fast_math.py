"""The core rejects fast-math, because a compiler that assumes no NaN would remove the guards of the tick."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROGRAM = '#include "punctura/model/piecewise_band.hpp"\nint main() { return 0; }\n'


def compile_with(option, tmp_path):
    source = tmp_path / "program.cpp"
    source.write_text(PROGRAM)
    compiler = os.environ.get("CXX") or shutil.which("c++") or shutil.which("g++") or "clang++"
    command = [compiler, "-std=c++20", f"-I{ROOT / 'core'}", "-fsyntax-only", option, str(source)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


@pytest.mark.parametrize("option", ["-ffast-math", "-ffinite-math-only"])
def test_the_core_refuses_to_compile_without_nan(tmp_path, option):
    done = compile_with(option, tmp_path)
    assert done.returncode != 0 and "cannot be compiled with -ffast-math" in done.stderr


def test_it_compiles_with_optimisation(tmp_path):
    assert compile_with("-O2", tmp_path).returncode == 0
