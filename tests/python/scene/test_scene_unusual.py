"""A number of a scene file that is off by a factor of 1,000 is told with file, line and key."""

import subprocess
import sys
import warnings
from pathlib import Path

import punctura
import pytest
from punctura import ProfileLaw, load_scene, scene_names
from punctura.scene import scene_text
from punctura.scene.check import UnusualWarning
from punctura.studio.loaded import from_name, from_tables


def notes_of(path):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        load_scene(path)
    assert all(warning.category is UnusualWarning for warning in caught)
    return [str(warning.message) for warning in caught]


@pytest.mark.parametrize(
    "sound, given, line, advice",
    [
        ("diameter_mm = 1.08", "diameter_mm = 1080", "line 5: [needle]", "If you meant 1080 um, write 1.08"),
        ("diameter_mm = 1.08", "diameter_mm = 0.00108", "line 5: [needle]", "If you meant 0.00108 m, write 1.08"),
        ("N_per_mm = 0.4", "N_per_mm = 400.0", "line 9: [coupling]", "If you meant 400 N/m, write 0.4"),
        ("N_per_mm = 0.57", "N_per_mm = 570", "line 14: [[membrane]]", "If you meant 570 N/m, write 0.57"),
        ("N_per_mm = 0.57", "N_per_mm = 0.00057", "line 14: [[membrane]]", "If you meant 0.00057 N/um, write 0.57"),
        ("ion_N = 0.41", "ion_N = 410.0", "line 15: [[membrane]]", "If you meant 410 mN, write 0.41"),
        ("ness_mm = 1.0", "ness_mm = 1000.0", "line 17: [[membrane]]", "If you meant 1000 um, write 1"),
    ],
)
def test_the_warning_names_the_line_and_what_to_write(tmp_path, sound_text, sound, given, line, advice):
    path = tmp_path / "veins.toml"
    path.write_text(sound_text.replace(sound, given, 1))
    [note] = notes_of(path)
    assert note.startswith(f"{path}, {line} ") and note.endswith(f"{given} is unusual. {advice}")


@pytest.mark.parametrize(
    "sound, given, advice",
    [
        ("bore_mm = 15", "bore_mm = 0.015", "If you meant 0.015 m, write 15"),
        ("bore_mm = 15", "bore_mm = 15000", "If you meant 15000 um, write 15"),
        ("liquid_mL = 3", "liquid_mL = 3000", "If you meant a number 1000 times smaller, write 3"),
        ("friction_N = 0.3", "friction_N = 300", "If you meant 300 mN, write 0.3"),
        (
            "resistance_kPa_s_per_mL = 2.5",
            "resistance_kPa_s_per_mL = 2500000000.0",
            "If you meant 2.5e+09 Pa s/m^3, write 2.5",
        ),
        ("thumb_stiffness_N_per_mm = 1.0", "thumb_stiffness_N_per_mm = 1000", "If you meant 1000 N/m, write 1"),
    ],
)
def test_the_numbers_of_a_syringe_are_told_as_well(tmp_path, sound, given, advice):
    path = tmp_path / "epidural.toml"
    text = (Path(punctura.__file__).parent / "ready_scenes/epidural.toml").read_text()
    assert sound in text
    path.write_text(text.replace(sound, given, 1))
    [note] = notes_of(path)
    assert f": [syringe] {given.split()[0]}" in note and note.endswith(f"is unusual. {advice}")


def test_sound_scenes_give_no_warning(tmp_path, sound_text):
    (tmp_path / "a.toml").write_text(sound_text)
    assert [notes_of(scene) for scene in (tmp_path / "a.toml", *scene_names())] == [[]] * (1 + len(scene_names()))


def test_the_command_line_tells_it_as_a_sentence(tmp_path, sound_text):
    path, motion = tmp_path / "veins.toml", tmp_path / "motion.csv"
    path.write_text(sound_text.replace("diameter_mm = 1.08", "diameter_mm = 1080"))
    motion.write_text("time_s,x_m,y_m,z_m\n" + "".join(f"{i / 1000},0,0,0\n" for i in range(20)))
    command = [
        sys.executable,
        "-m",
        "punctura",
        "simulate",
        path,
        "--motion",
        motion,
        "--out",
        tmp_path / "out.csv",
    ]
    done = subprocess.run(command, capture_output=True, text=True)
    wanted = f"punctura: warning: {path}, line 5: [needle] diameter_mm = 1080 is unusual. If you meant 1080 um, write"
    assert [line for line in done.stderr.splitlines() if "unusual" in line] == [f"{wanted} 1.08"]


def test_the_studio_knows_it_of_files_and_of_edited_tables(tmp_path, sound_text):
    (tmp_path / "a.toml").write_text(sound_text.replace("diameter_mm = 1.08", "diameter_mm = 1080"))
    loaded = from_name(str(tmp_path / "a.toml"))
    assert "line 5: [needle] diameter_mm = 1080" in loaded.unusual[0]
    assert from_tables(loaded.tables()).unusual[0].startswith("needle.diameter_mm = 1080.0 is unusual.")


PROFILE = """
profile_depth_mm = [0.0, 0.001, 4.0]
profile_lower_N = [0.0, -0.00005, -0.4]
profile_upper_N = [0.0, 0.05, 0.1]
"""


@pytest.mark.parametrize(
    ("given", "instead", "said"),
    [
        ("[0.0, 0.001, 4.0]", "[0.0, 1.0, 4000.0]",
         "profile_depth_mm has 4000, which is unusual. If you meant 4000 um, write 4"),
        ("[0.0, 0.001, 4.0]", "[0.0, 0.001, 0.004]",
         "profile_depth_mm has 0.004, which is unusual. If you meant 0.004 m, write 4"),
        ("[0.0, -0.00005, -0.4]", "[0.0, -300.0, -400.0]",
         "profile_lower_N has -400, which is unusual. If you meant -400 mN, write -0.4"),
    ],
)  # fmt: skip
def test_a_profile_in_another_unit_is_named_once(tmp_path, given, instead, said):
    text = scene_text(load_scene("k06-fig10"))
    path = tmp_path / "profile.toml"
    path.write_text(text.rstrip() + PROFILE, encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        load_scene(path)
    path.write_text(text.rstrip() + PROFILE.replace(given, instead), encoding="utf-8")
    with pytest.warns(UnusualWarning) as caught:
        load_scene(path)
    (note,) = [str(one.message) for one in caught]
    assert ": [[membrane]] profile_" in note and note.endswith(said)


def test_a_profile_law_in_another_unit_is_named():
    with pytest.warns(UserWarning, match=r"depth has 4 m, which is unusual. If you meant 4 mm, write 0.004"):
        ProfileLaw([0, 4], [0, -0.4], [0, 0.1])
    with pytest.warns(UserWarning, match=r"lower has -400 N, which is unusual. If you meant -400 mN, write -0.4"):
        ProfileLaw([0, 4e-3], [0, -400], [0, 0.1])
