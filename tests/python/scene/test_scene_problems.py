"""All problems of a scene file are reported at once, in the file's keys and units."""

import pytest
from punctura import ConfigurationError, load_scene
from punctura.exercise import load_exercise


def lines(path):
    with pytest.raises(ConfigurationError) as caught:
        load_scene(path)
    head, *rest = str(caught.value).split("\n")
    count = len(caught.value.problems)
    assert head == f"{path}: {count} problem{'s' if count != 1 else ''}"
    assert len(rest) == count
    return [line.removeprefix("  ") for line in rest]


ONE_PROBLEM = {
    "a friction that bars insertion": (
        ("friction = 0.2", "friction = 3.6"),
        "membrane[0].friction = 3.6: the largest value that is allowed with this tip angle is 3.477, K06 (7)",
    ),
    "a negative thickness": (
        ("thickness_mm = 1.0", "thickness_mm = -1"),
        "membrane[0].thickness_mm = -1: must be 0 (the thin law) or more",
    ),
    "a value that is not finite": (
        ("precompression_N = 0.41", "precompression_N = nan"),
        "membrane[0].precompression_N = nan: must be a finite number",
    ),
    "a point that is not finite": (
        ("[0, -4, 0]", "[0, -4, inf]"),
        "membrane[1].point_mm = [0, -4, inf]: must be three finite numbers, m, within 1000 km",
    ),
    "a normal of no length": (
        ("[0, -1, 0]", "[0, 0, 0.0]"),
        "membrane[0].inward_normal = [0, 0, 0.0]: must be a direction: at least one of the three not 0",
    ),
    "an angle beyond its bound, in the file's unit": (
        ("tip_angle_rad = 0.28", "tip_angle_deg = 95.5"),
        "needle.tip_angle_deg = 95.5: must be between 0 and pi/2 rad: a blunt needle does not enter, K06 (7) "
        "(less than 90 deg)",
    ),
    "a rate out of bounds": (
        ("[coupling]", "[servo]\nrate_hz = 50\n[coupling]"),
        "servo.rate_hz = 50: must be from 100 to 100000 Hz: below, forces step; above, no device follows",
    ),
    "a misspelt key": (
        ("friction = 0.2", "friction = 0.2\nthicknes_mm = 1"),
        "membrane[0].thicknes_mm = 1: unknown key; did you mean thickness_mm?",
    ),
    "a key without its unit": (
        ("friction = 0.2", "friction = 0.2\npoint = [0, 0, 0]"),
        "membrane[0].point = [0, 0, 0]: unknown key; did you mean point_mm?",
    ),
    "a key like no other": (
        ("[needle]", "[needle]\ncolour = 'red'"),
        "needle.colour = 'red': unknown key; known here: diameter_mm, gauge, tip_angle_rad, tip_angle_deg, direction",
    ),
    "an unknown table": (
        ("[needle]", "[foo]\n[needle]"),
        "foo: unknown key; known here: name, needle, coupling, servo, display, syringe, membrane",
    ),
    "text for a number": (
        ("stiffness_N_per_mm = 0.4", 'stiffness_N_per_mm = "stiff"'),
        "coupling.stiffness_N_per_mm = 'stiff': must be a number (N/mm)",
    ),
    "a truth value for a number": (
        ("friction = 0.2", "friction = true"),
        "membrane[0].friction = True: must be a number",
    ),
    "two numbers for a point": (
        ("point_mm = [0, 0, 0]", "point_mm = [0, 0]"),
        "membrane[0].point_mm = [0, 0]: must be three numbers, [x, y, z] (mm)",
    ),
    "a number for a name": (('name = "test"', "name = 3"), "name = 3: must be text, in quotes"),
    "a direction that is none": (
        ("0.28", "0.28\ndirection = 'up'"),
        "needle.direction = 'up': must be 'stylus' or 'motion'",
    ),
    "a solver that is none": (
        ("[coupling]", "[servo]\nsolver = 'fast'\n[coupling]"),
        "servo.solver = 'fast': must be 'paper' or 'exact'",
    ),
    "a conditioning that is none": (
        ("[coupling]", "[servo]\nconditioning = 'smooth'\n[coupling]"),
        "servo.conditioning = 'smooth': must be 'low_pass' or 'line_fit'",
    ),
    "an encoder step in micrometres": (
        ("[coupling]", "[servo]\nencoder_step_mm = 55\n[coupling]"),
        "servo.encoder_step_mm = 55: must be from 0 (an ideal sensor) to 0.001 m: no device counts coarser "
        "(at most 1 mm)",
    ),
    "half a step in a tick": (
        ("[coupling]", "[servo]\nsub_steps = 1.5\n[coupling]"),
        "servo.sub_steps = 1.5: must be from 1 to 16, a whole number",
    ),
    "a branch without its time": (
        ("damping_Ns_per_mm = 0.001", "damping_Ns_per_mm = 0.001\nrelaxation_stiffness_N_per_mm = [0.1]"),
        "coupling.relaxation_time_constant_s = []: must have as many numbers as relaxation_stiffness_N_per_mm, "
        "which has 1",
    ),
    "a branch that relaxes at once": (
        (
            "damping_Ns_per_mm = 0.001",
            "damping_Ns_per_mm = 0.001\nrelaxation_stiffness_N_per_mm = [0.1, 0.2]\n"
            "relaxation_time_constant_s = [1, 0]",
        ),
        "coupling.relaxation_time_constant_s[1] = 0: must be from 0.0001 to 10000 s: from less than a "
        "tick to longer than a run",
    ),
    "three branches": (
        (
            "damping_Ns_per_mm = 0.001",
            "damping_Ns_per_mm = 0.001\nrelaxation_stiffness_N_per_mm = [1, 2, 3]\n"
            "relaxation_time_constant_s = [1, 2, 3]",
        ),
        "coupling.relaxation_stiffness_N_per_mm = [1, 2, 3]: there may be at most two branches",
    ),
    "a profile that pulls the needle in": (
        (
            "thickness_mm = 1.0",
            "thickness_mm = 1.0\nprofile_depth_mm = [0, 1]\nprofile_lower_N = [0, 0.5]\nprofile_upper_N = [0, 1]",
        ),
        "membrane[0].profile_lower_N[1] = 0.5: must be from -1e+06 to 0 N: the lower edge resists insertion",
    ),
    "a grip of words": (
        ("thickness_mm = 1.0", 'thickness_mm = 1.0\ngrip = "table"\ngrip_opening_mm = ["wide"]'),
        "membrane[0].grip_opening_mm = ['wide']: must be a list of numbers, as [0, 0.5, 1] (mm)",
    ),
    "more than the whole friction behind a tail": (
        ("thickness_mm = 1.0", "thickness_mm = 1.0\ntail_floor = 1.5"),
        "membrane[0].tail_floor = 1.5: must be from 0 to 1",
    ),
    "a missing key": (("friction = 0.2\n", ""), "membrane[0].friction: is missing"),
    "a missing name": (('name = "test"\n', ""), "name: is missing"),
    "no diameter at all": (
        ("diameter_mm = 1.08\n", ""),
        "needle.diameter_mm: is missing; give either diameter_mm or gauge",
    ),
    "no tip angle at all": (
        ("tip_angle_rad = 0.28\n", ""),
        "needle.tip_angle_rad: is missing; give either tip_angle_rad or tip_angle_deg",
    ),
    "two diameters": (
        ("diameter_mm = 1.08", "diameter_mm = 1.08\ngauge = 19"),
        "needle.gauge = 19: give either diameter_mm or gauge, not both",
    ),
    "two tip angles": (
        ("tip_angle_rad = 0.28", "tip_angle_rad = 0.28\ntip_angle_deg = 16"),
        "needle.tip_angle_deg = 16: give either tip_angle_rad or tip_angle_deg, not both",
    ),
    "a gauge that there is not": (
        ("diameter_mm = 1.08", "gauge = 50"),
        "needle.gauge = 50: must be a gauge of ISO 9626, 10 to 34",
    ),
    "a broken gauge": (("diameter_mm = 1.08", "gauge = 19.5"), "needle.gauge = 19.5: must be a whole number"),
}


@pytest.mark.parametrize("case", ONE_PROBLEM)
def test_a_problem_is_told_with_path_value_bound_and_reason(write, case):
    change, line = ONE_PROBLEM[case]
    assert lines(write(change)) == [line]


def test_all_problems_of_type_and_of_value_come_at_once_in_the_order_of_the_file(write):
    path = write(
        ("diameter_mm = 1.08", "diametre_mm = 1.08"),
        ("damping_Ns_per_mm = 0.001", "damping_Ns_per_mm = -1"),
        ("thickness_mm = 1.0", 'thickness_mm = "thin"'),
        ("thickness_mm = 0.5", "thickness_mm = -1"),
        ("inward_normal = [0, -2, 0]", ""),
    )
    assert lines(path) == [
        "needle.diametre_mm = 1.08: unknown key; did you mean diameter_mm?",
        "needle.diameter_mm: is missing; give either diameter_mm or gauge",
        "coupling.damping_Ns_per_mm = -1: must be 0 or more, K06 (21)",
        "membrane[0].thickness_mm = 'thin': must be a number (mm)",
        "membrane[1].thickness_mm = -1: must be 0 (the thin law) or more",
        "membrane[1].inward_normal: is missing",
    ]


def test_insertion_is_checked_for_a_membrane_that_has_other_problems(write):
    path = write(("friction = 0.2\nthickness_mm = 1.0", "friction = 3.6\nthickness_mm = -1"))
    assert [line.split(":")[0] for line in lines(path)] == [
        "membrane[0].friction = 3.6",
        "membrane[0].thickness_mm = -1",
    ]


def test_a_value_of_the_wrong_type_causes_no_second_problem(write):
    assert len(lines(write(("tip_angle_rad = 0.28", "tip_angle_rad = []")))) == 1
    assert len(lines(write(("diameter_mm = 1.08", "gauge = 'thick'")))) == 1


def test_an_exercise_is_told_to_be_one_and_where_it_opens():
    assert lines(load_exercise("venipuncture").path) == [
        "this is an exercise, not a scene; punctura run --exercise FILE lists it in the tab Exercises of the page"
    ]


def test_an_empty_file_lacks_every_table(write):
    assert lines(write(text="")) == [
        "name: is missing",
        "needle: is missing; write a table [needle]",
        "coupling: is missing; write a table [coupling]",
        "membrane: is missing; write a table [[membrane]]",
    ]


def test_a_scene_needs_a_membrane(write):
    text = 'name = "x"\nmembrane = []\n[needle]\ngauge = 19\ntip_angle_rad = 0.2\n'
    text += "[coupling]\nstiffness_N_per_mm = 1\ndamping_Ns_per_mm = 0\n"
    assert lines(write(text=text)) == ["membrane = []: there must be at least one membrane to go through"]


def test_one_membrane_table_must_be_a_list_of_one(write):
    path = write(("[[membrane]]", "[membrane]"), text=write().read_text().split('[[membrane]]\nname = "wall"')[0])
    assert lines(path) == ["membrane: must be a list of tables; begin each with [[membrane]]"]


def test_a_number_where_a_table_belongs_is_reported(write):
    text = write().read_text().replace("[coupling]\nstiffness_N_per_mm = 0.4\ndamping_Ns_per_mm = 0.001\n", "")
    assert lines(write(text="coupling = 3\n" + text)) == ["coupling = 3: must be a table, [coupling]"]


def test_a_slip_of_toml_is_told_with_line_and_column(write):
    assert lines(write(text='name = "x"\n[needle\n')) == [
        "line 2, column 8: is not TOML: Expected ']' at the end of a table declaration"
    ]
    assert lines(write(text='name = "x')) == ["line 1, at the end of the file: is not TOML: Unterminated string"]


def test_a_file_that_is_not_utf_8_is_told_with_its_line(tmp_path):
    path = tmp_path / "latin.toml"
    path.write_bytes(b'name = "x"\n# \xe9\n')
    assert lines(path) == ["line 2: is not UTF-8 text; save it as UTF-8"]


def test_a_missing_file_and_a_folder_are_reported(tmp_path):
    assert lines(tmp_path / "none.toml") == ["there is no such file"]
    assert lines(tmp_path) == ["is a folder, not a scene file"]


def test_a_name_that_is_no_ready_scene_lists_those_that_are():
    assert lines("k06-fig1") == [
        "no file and no ready scene has this name; ready scenes: "
        "epidural, k06-fig10, k06-fig11, k06-fig12, two-membranes, venipuncture"
    ]
