"""The values of a scene file arrive in the core, in SI; the ready ones are those of the paper."""

import math
from pathlib import Path

import numpy as np
import pytest
from punctura import Insertion, load_scene, scene_names
from punctura.scene import DisplaySettings, ServoSettings


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


def push(name, depth, degrees=90.0, speed=5e-3):
    """Depth of the device (m) and force against the needle (N) along a steady insertion, and the trace."""
    scene = load_scene(name)
    angle = np.radians(degrees)
    axis = np.array([np.cos(angle), -np.sin(angle), 0.0])
    way = np.arange(-1e-3, depth, speed / scene.servo.rate)
    trace = Insertion(scene).run(way[:, None] * axis, axis)
    return way, -trace.force @ axis, trace


def test_the_scenes_of_the_paper_two_procedures_and_that_of_an_exercise_are_there():
    assert scene_names() == ["epidural", "k06-fig10", "k06-fig11", "k06-fig12", "two-membranes", "venipuncture"]


@pytest.mark.parametrize(
    ("name", "thickness"), [("k06-fig10", [1e-4]), ("k06-fig11", [4e-3]), ("k06-fig12", [1e-3, 5e-4])]
)
def test_the_paper_s_scenes_hold_the_values_of_its_section_4(name, thickness):
    scene = load_scene(name)
    assert (scene.needle.diameter, scene.needle.tip_angle) == (1.08e-3, 0.28)
    assert (scene.coupling.stiffness, scene.coupling.damping) == (400.0, 1.0)
    assert (scene.servo.rate, scene.servo.low_pass, scene.servo.conditioning) == (1600.0, 300.0, "low_pass")
    assert [p.membrane.thickness for p in scene.membranes] == thickness
    for placed in scene.membranes:
        m = placed.membrane
        assert (m.stiffness, m.precompression, m.friction) == (570.0, 0.41, 0.2)
        assert tuple(placed.inward_normal) == (0.0, -1.0, 0.0)


def test_three_millimetres_lie_between_the_membranes_of_figure_12():
    first, second = load_scene("k06-fig12").membranes
    assert first.point[1] - first.membrane.thickness - second.point[1] == pytest.approx(3e-3)


def test_two_membranes_are_those_of_figure_12_with_a_force_that_a_device_can_give_for_long():
    figure = load_scene("k06-fig12")
    assert load_scene("two-membranes") == figure.replace(name="Two membranes", display=DisplaySettings("automatic"))


def test_the_thin_membrane_pops_from_0_73_to_0_41_newton():
    _, force, _ = push("k06-fig10", 12e-3)
    assert force.max() == pytest.approx(0.7296, abs=2e-4)
    assert force[-1] == pytest.approx(0.41024, abs=1e-5)


def test_venipuncture_needs_no_force_scale_on_a_device_of_3_3_newton():
    assert 0.5 < push("venipuncture", 30e-3, 30)[1].max() < 3.3


def test_no_layer_of_the_epidural_pushes_the_needle_out():
    scene = load_scene("epidural")
    down = np.array([0.0, -1.0, 0.0])
    way = np.concatenate([np.arange(-1e-3, 60e-3, 5e-6), np.arange(60e-3, -1e-3, -5e-6)])
    needle = Insertion(scene)
    force = -needle.run(way[:, None] * down, down).force @ down
    assert force[np.argmax(way) :].min() < -0.5  # drawn back, the layers hold it ...
    assert force[np.argmax(way) + 1000 :].max() < 1e-12  # ... and never push


def test_resistance_is_lost_behind_the_flavum_and_before_the_dura():
    way, force, trace = push("epidural", 62e-3)
    names = [placed.name for placed in load_scene("epidural").membranes]
    flavum = np.abs(trace.axial_force[:, names.index("ligamentum flavum")])
    before = force[: np.argmax(flavum) + 1].max()
    assert before == force[way < 50e-3].max()  # the flavum is the hardest on the way to the space
    space = force[(way > way[np.argmax(flavum)]) & (way < 50e-3)]
    assert 11.5 < before < 12.5 and space.min() < 1
    dura = np.abs(trace.axial_force[:, names.index("dura")])
    assert not dura[way < 49.9e-3].any()


def test_skin_and_both_walls_of_the_vein_pop_one_after_the_other():
    way, force, trace = push("venipuncture", 30e-3, 30)
    pops = np.argmax(np.abs(trace.axial_force), axis=0)
    assert list(pops) == sorted(pops)
    lumen = slice(pops[1], np.argmax(trace.depth[:, 2] > 0))
    assert force[lumen].min() < 0.8 * force[pops[1]]  # the give that says: in the vein
    assert way[pops[1]] < way[np.argmax(trace.depth[:, 2] > 0)]
