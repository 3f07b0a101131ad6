"""A scene with a syringe: its file, its numbers, and the ticks of a run."""

import numpy as np
import pytest
from punctura import ConfigurationError, Coupling, load_scene, save_scene
from punctura._core import ServoLoop, SimulatedDevice
from punctura.record import Recorder, open_recording, replay
from punctura.simulation import Target
from punctura.syringe import Outlet, Syringe, SyringeSettings
from recorded import run_to_end
from waiting import wait_until

SYRINGE = SyringeSettings(Syringe(15e-3, 4e-6, 0.3e-6, 0.5, 1e-12, 2e9), Coupling(1500, 1))


def with_syringe():
    scene = load_scene("k06-fig10")
    wall = scene.membranes[0].replace(outflow=Outlet(1e13, 2000), outflow_behind=Outlet(5e8, 1000))
    return scene.replace(membranes=[wall], syringe=SYRINGE)


def test_a_written_scene_is_read_with_the_same_syringe(tmp_path):
    save_scene(with_syringe(), tmp_path / "scene.toml")
    assert load_scene(tmp_path / "scene.toml") == with_syringe()


def test_a_scene_without_a_syringe_has_no_key_of_one(tmp_path):
    save_scene(load_scene("k06-fig10"), tmp_path / "scene.toml")
    text = (tmp_path / "scene.toml").read_text()
    assert "syringe" not in text and "outflow" not in text
    assert load_scene("k06-fig10").syringe is None


def test_wrong_numbers_are_told_by_the_keys_of_the_file(tmp_path):
    save_scene(with_syringe(), tmp_path / "scene.toml")
    text = (tmp_path / "scene.toml").read_text()
    text = text.replace("bore_mm = 15.0", "bore_mm = -15.0").replace(
        "outflow_pressure_kPa = 2.0", "outflow_pressure_kPa = -200.0"
    )
    text = text.replace("thumb_stiffness_N_per_mm = 1.5", "thumb_stiffness_N_per_mm = 0.0")
    (tmp_path / "scene.toml").write_text(text)
    with pytest.raises(ConfigurationError) as error:
        load_scene(tmp_path / "scene.toml")
    assert {problem.path for problem in error.value.problems} == {
        "syringe.bore_mm", "syringe.thumb_stiffness_N_per_mm", "membrane[0].outflow_pressure_kPa",
    }  # fmt: skip


def test_a_syringe_needs_its_own_numbers(tmp_path):
    save_scene(load_scene("k06-fig10"), tmp_path / "scene.toml")
    (tmp_path / "scene.toml").write_text((tmp_path / "scene.toml").read_text() + "[syringe]\nbore_mm = 15\n")
    with pytest.raises(ConfigurationError) as error:
        load_scene(tmp_path / "scene.toml")
    assert "syringe.liquid_mL" in [problem.path for problem in error.value.problems]


def test_numbers_are_reached_by_their_paths():
    scene = with_syringe().with_values({"syringe.friction": 1.0, "membrane[0].behind_resistance": 1e9})
    assert scene.syringe.syringe.friction == 1.0
    assert scene.membranes[0].outflow_behind.resistance == 1e9
    assert not [f for f in load_scene("k06-fig10").fields() if "syringe" in f.path or "outflow" in f.path]


def test_the_ready_epidural_has_a_syringe_whose_resistance_is_lost_behind_the_flavum():
    scene = load_scene("epidural")
    flavum = next(m for m in scene.membranes if m.name == "ligamentum flavum")
    assert flavum.outflow.resistance > 1000 * flavum.outflow_behind.resistance
    assert scene.syringe is not None


def run(loop, device, listener):
    with loop:
        loop.start()
        wait_until(lambda: device.finished)
    return listener.read()


def test_a_run_records_the_syringe_and_a_run_without_one_records_nan():
    for scene, has in ((with_syringe(), True), (load_scene("k06-fig10"), False)):
        device = SimulatedDevice(Target([0, 5e-3, 0]), real_time=False, ticks=200)
        loop = ServoLoop(device, scene)
        ticks = run(loop, device, loop.listen())
        assert (np.isfinite(ticks.plunger).all() and np.isfinite(ticks.pressure).all()) == has
        assert np.isnan(ticks.thumb_force).all() != has


def test_a_replay_has_the_recorded_thumb_and_so_the_same_plunger(tmp_path):
    device = SimulatedDevice(Target([0, 5e-3, 0]), real_time=False, ticks=1600)
    loop = ServoLoop(device, with_syringe())
    with Recorder(loop, tmp_path / "run.parquet", 1600):
        loop.push_plunger(3)
        run_to_end(loop)
    ticks = open_recording(tmp_path / "run.parquet").ticks()
    assert ticks.thumb[-1] > 0 and ticks.injected[-1] > 0
    result = replay(tmp_path / "run.parquet")
    assert (result.ticks, result.identical, result.complete) == (1600, True, True), result
