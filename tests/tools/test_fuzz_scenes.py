"""A short run of tools/fuzz_scenes.py with a fixed seed."""

import importlib
from pathlib import Path

import pytest

TOOLS = Path(__file__).resolve().parents[2] / "tools"


@pytest.fixture
def fuzzer(monkeypatch):
    monkeypatch.syspath_prepend(str(TOOLS))
    return importlib.import_module("fuzz_scenes")


def test_a_spoilt_scene_file_is_a_scene_or_is_refused_with_paths_and_reasons(fuzzer, tmp_path):
    tally = fuzzer.fuzz(tmp_path, seed=7, cases=300)
    assert tally.cases == 300
    assert 20 < tally.scenes < 200


def test_the_sound_scenes_that_the_fuzzer_spoils_are_sound(fuzzer, tmp_path):
    for text in importlib.import_module("spoil_scene").SEEDS:
        path = tmp_path / "sound.toml"
        path.write_text(text, encoding="utf-8")
        assert fuzzer.judge(path)


def test_a_case_is_the_same_each_time(fuzzer):
    assert fuzzer.case_bytes(3, 14) == fuzzer.case_bytes(3, 14) != fuzzer.case_bytes(3, 15)
