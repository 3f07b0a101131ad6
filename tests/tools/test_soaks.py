"""Runs the soaks and fuzzers for a few seconds each, those of the studio with `./test statistics`."""

import os
import subprocess
import sys
from pathlib import Path

import fuzz_scenes
import pytest
from spoil_scene import SEEDS

TOOLS = Path(__file__).parents[2] / "tools"


@pytest.mark.statistics
@pytest.mark.skipif(os.name != "posix", reason="ends the studio by a signal")
@pytest.mark.parametrize(
    "command",
    [
        ["soak_studio.py", "--minutes", "0.05"],
        ["fuzz_studio.py", "--minutes", "0.05"],
        ["soak_sockets.py", "silent", "--seconds", "2"],
    ],
    ids=" ".join,
)
def test_a_short_run_passes(command):
    tool, *more = command
    done = subprocess.run([sys.executable, str(TOOLS / tool), *more], capture_output=True, text=True, timeout=180)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "passed" in done.stdout


def test_a_spoilt_scene_file_is_a_scene_or_is_refused_with_paths_and_reasons(tmp_path):
    tally = fuzz_scenes.fuzz(tmp_path, seed=7, cases=300)
    assert tally.cases == 300
    assert 20 < tally.scenes < 200


def test_the_sound_scenes_that_the_fuzzer_spoils_are_sound(tmp_path):
    for text in SEEDS:
        path = tmp_path / "sound.toml"
        path.write_text(text, encoding="utf-8")
        assert fuzz_scenes.judge(path)


def test_a_case_is_the_same_each_time():
    assert fuzz_scenes.case_bytes(3, 14) == fuzz_scenes.case_bytes(3, 14) != fuzz_scenes.case_bytes(3, 15)
