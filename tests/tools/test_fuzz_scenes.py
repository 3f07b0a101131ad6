"""A short run of tools/fuzz_scenes.py with a fixed seed."""

import fuzz_scenes
from spoil_scene import SEEDS


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
