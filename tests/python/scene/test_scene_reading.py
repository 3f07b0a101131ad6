"""The values of a scene file arrive in the core, in SI."""

import math
from pathlib import Path

import pytest
from punctura import load_scene
from punctura.scene import ServoSettings


def test_every_value_arrives_in_si_rounded_once(write):
    scene = load_scene(write())
    assert scene.name == "test"
    assert (scene.needle.diameter, scene.needle.tip_angle) == (0.00108, 0.28)
    assert (scene.coupling.stiffness, scene.coupling.damping) == (400.0, 1.0)
    skin, wall = scene.membranes
    assert (skin.name, wall.name) == ("skin", "wall")
    assert (skin.membrane.stiffness, skin.membrane.precompression) == (570.0, 0.41)
    assert (skin.membrane.friction, skin.membrane.thickness) == (0.2, 0.001)
    assert tuple(wall.point) == (0.0, -0.004, 0.0)


def test_what_is_left_out_takes_the_defaults_of_the_core(write):
    scene, defaults = load_scene(write()), ServoSettings()
    assert (scene.servo.rate, scene.servo.low_pass) == (defaults.rate, defaults.low_pass)
    assert scene.servo == defaults
    assert (defaults.solver, defaults.conditioning) == ("exact", "low_pass")
    assert scene.direction == "stylus"


def test_the_servo_table_may_be_given_in_part(write):
    scene = load_scene(write(("[coupling]", '[servo]\nrate_hz = 2000\nsolver = "paper"\n\n[coupling]')))
    assert (scene.servo.rate, scene.servo.low_pass, scene.servo.solver) == (2000.0, 300.0, "paper")


def test_the_conditioning_and_the_step_of_the_encoders_arrive(write):
    servo = load_scene(
        write(("[coupling]", '[servo]\nconditioning = "line_fit"\nencoder_step_mm = 0.01\n\n[coupling]'))
    ).servo
    assert (servo.conditioning, servo.encoder_step) == ("line_fit", 1e-5)
    assert servo.low_pass == 300.0


def test_the_direction_may_come_from_the_motion(write):
    assert load_scene(write(("0.28", '0.28\ndirection = "motion"'))).direction == "motion"


def test_an_angle_in_degrees_is_rounded_once(write):
    scene = load_scene(write(("tip_angle_rad = 0.28", "tip_angle_deg = 45")))
    assert scene.needle.tip_angle == math.pi / 4


@pytest.mark.parametrize(("gauge", "diameter"), [(10, 3.4e-3), (18, 1.2e-3), (19, 1.1e-3), (25, 0.5e-3), (34, 0.18e-3)])
def test_a_gauge_is_the_diameter_of_iso_9626(write, gauge, diameter):
    assert load_scene(write(("diameter_mm = 1.08", f"gauge = {gauge}"))).needle.diameter == diameter


def test_a_normal_of_any_length_is_a_direction(write):
    long = load_scene(write(("[0, -1, 0]", "[0, -1e200, 0]")))
    assert long.membranes[0].inward_normal[1] < 0


def test_a_byte_order_mark_and_windows_line_ends_are_read_over(write):
    path = write()
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes().replace(b"\n", b"\r\n"))
    assert load_scene(path).name == "test"


def test_a_path_may_be_text_or_a_path(write):
    path = write()
    assert load_scene(str(path)).name == load_scene(Path(path)).name == "test"
