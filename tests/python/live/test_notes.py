"""What a run says: the friction that its device needs, and why it has fewer ticks than its duration asks for."""

import numpy as np
import punctura as pn
import pytest
from punctura import Coupling, MaxwellBranch, load_scene, scene_names
from punctura.live import (
    DeviceInfo,
    FedDevice,
    ServoLoop,
    SimulatedDevice,
    damping_note,
    needed_damping,
    run_live,
    strokes_through,
)
from punctura.live.summary import Ticked
from punctura.scene import DisplaySettings
from punctura.simulation import Plant, Target
from punctura.studio.loaded import from_name
from punctura.studio.run import Bench, Run, Settings

STEP = Plant().encoder_step
FILTERS = {
    "none": {"conditioning": "low_pass", "low_pass": 0},
    "low_pass": {"conditioning": "low_pass", "low_pass": 300},
    "line_fit": {"conditioning": "line_fit", "encoder_step": STEP},
}


def filtered(name, kind, **more):
    scene = load_scene(name)
    return scene.replace(servo=scene.servo.replace(**FILTERS[kind] | more))


def line_end(samples, lead):
    """The weights, newest first, of the end of a least-squares line, extrapolated by `lead` ticks."""
    age = np.arange(samples)
    return np.linalg.pinv(np.stack([np.ones(samples), -age], axis=1)).T @ [1, lead]


def required(scene, weights, gain):
    """Colgate and Schenkel's bound for a filter of these weights and a low-pass of this gain behind it, N s/m."""
    T, w = 1 / scene.servo.rate, np.linspace(0.001, np.pi, 5001)
    delay = np.exp(-1j * w)
    coupling = scene.coupling.stiffness + scene.coupling.damping * (1 - delay) / T
    for branch in scene.relaxation:
        a = np.exp(-T / branch.time_constant)
        coupling += branch.stiffness * (1 - a) * branch.time_constant / T * (1 - delay) / (1 - a * delay)
    position = sum(weight * delay**k for k, weight in enumerate(weights)) * gain / (1 - (1 - gain) * delay)
    need = T / 2 / (1 - np.cos(w)) * np.real((1 - delay) * coupling * position)
    return len(scene.membranes) * need.max()


@pytest.mark.parametrize("name", scene_names())
def test_without_a_filter_it_is_the_formula_of_a_virtual_wall_once_for_each_membrane(name):
    scene = filtered(name, "none")
    K, B, n = scene.coupling.stiffness, scene.coupling.damping, len(scene.membranes)
    assert needed_damping(scene) == pytest.approx(n * (K / scene.servo.rate / 2 + B), rel=1e-12)
    assert needed_damping(filtered(name, "line_fit", encoder_step=0)) == needed_damping(scene)


@pytest.mark.parametrize("name", scene_names())
@pytest.mark.parametrize("relaxation", [[], [MaxwellBranch(300, 0.05), MaxwellBranch(900, 0.002)]])
def test_with_a_filter_it_is_the_bound_of_that_filter_and_of_the_worst_window(name, relaxation):
    low_pass = filtered(name, "low_pass").replace(relaxation=relaxation)
    gain = 1 - np.exp(-2 * np.pi * 300 / 1600)
    assert needed_damping(low_pass) == pytest.approx(required(low_pass, [1], gain), rel=1e-3)

    coarse = filtered(name, "line_fit").replace(relaxation=relaxation)
    gain = 1 - np.exp(-2 * np.pi * 200 / 1600)
    windows = [[1], *(line_end(samples, 1 / gain - 1) for samples in (25, 13, 7, 3))]
    expected = max(required(coarse, weights, gain) for weights in windows)
    assert needed_damping(coarse) == pytest.approx(expected, rel=1e-3)


def test_it_counts_every_membrane_and_is_proportional_to_the_coupling():
    scene = filtered("k06-fig10", "line_fit")
    two = filtered("k06-fig12", "line_fit")
    assert needed_damping(two) == pytest.approx(2 * needed_damping(scene), rel=1e-12)
    half = scene.replace(coupling=Coupling(scene.coupling.stiffness / 2, scene.coupling.damping / 2))
    assert needed_damping(half) == pytest.approx(needed_damping(scene) / 2, rel=1e-12)


def fed(scene):
    return ServoLoop(FedDevice(scene.servo.rate, info=DeviceInfo(model="a stylus")), scene)


def test_the_note_has_the_damping_and_the_speed_up_to_which_the_friction_of_an_omni_does():
    scene = filtered("venipuncture", "line_fit")
    assert needed_damping(scene) == pytest.approx(5.42, abs=0.005)
    note = damping_note(fed(scene))
    assert "the friction of a stylus is not known" in note
    assert "5.4 N s/m" in note and "0.26 N, as an Omni has, are enough up to 48 mm/s" in note
    scaled = damping_note(fed(scene.replace(display=DisplaySettings(0.5))))
    assert "2.7 N s/m" in scaled and "96 mm/s" in scaled


def test_nobody_holds_a_simulated_device_so_there_is_no_note():
    scene = load_scene("venipuncture")
    device = SimulatedDevice(strokes_through(scene), axis=scene.membranes[0].inward_normal, real_time=False, ticks=10)
    assert damping_note(ServoLoop(device, scene)) == ""
    run = Run(1, Bench(Settings("simulated"), scene), from_name("venipuncture"))
    assert not any("friction" in note for note in run.notes)


class Seen(Exception):
    pass


def test_run_live_has_it_in_the_summary_from_the_start_on():
    scene, seen = filtered("venipuncture", "line_fit"), []
    device = FedDevice(scene.servo.rate)  # in real time: a hand may hold it

    def watch(summary):
        seen.append(list(summary.statements))
        raise Seen

    with pytest.raises(Seen):
        run_live(device, scene, watch=watch)
    assert any("5.4 N s/m" in statement for statement in seen[0])


SCENE = pn.load_scene("k06-fig12")
WHOLE = {"duration": 2.0, "rate": 1600.0, "ticks": 3200, "span": 1.999, "late": 0, "longest": 0.7e-3}


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({}, ""),
        ({"ticks": 3180, "span": 1.9875}, ""),
        ({"ticks": 0}, ""),
        ({"ticks": 3000, "late": 40, "longest": 0.03}, "199 were left out because the computer or the device was late "
         "40 times, by up to 0.029 s"),
        ({"ticks": 2000}, "the device ticks at 1001 Hz"),
        ({"ticks": 2880, "span": 1.8}, "for 0.2 s at the beginning or the end the device gave none"),
        ({"ticks": 900, "span": 0.5625, "device_ended": True}, "the device ended after 0.562 s"),
        ({"ticks": 900, "span": 0.5625, "fault": "a jump"}, "the fault ended the run"),
    ],
)  # fmt: skip
def test_the_cause_is_named(changed, said):
    ticked = Ticked(**(WHOLE | changed))
    head = f"{ticked.ticks} ticks came, and 2 s at 1600 Hz are 3200: "
    assert ticked.why_short() == (said and head + said)


def test_a_device_that_ends_before_the_duration_is_named_in_the_summary():
    device = SimulatedDevice(Target([0, 5e-3, 0]), real_time=False, ticks=400)
    summary = run_live(device, SCENE, 2.0)
    assert summary.ticks == 400 and summary.too_few_ticks.startswith("400 ticks came, and 2 s at 1600 Hz are 3200")
    assert "the device ended" in summary.too_few_ticks
    again = SimulatedDevice(Target([0, 5e-3, 0]), real_time=False, ticks=400)
    assert run_live(again, SCENE).too_few_ticks == ""
