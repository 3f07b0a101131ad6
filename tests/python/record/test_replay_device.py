"""A recorded motion as a device, with its own scene and with another one; scenes beyond K06 are replayed."""

import json

import numpy as np
import pyarrow.parquet as pq
import pytest
from punctura import ConfigurationError, MaxwellBranch, Tissue, load_scene
from punctura._core import DeviceError, GateLimits, ReplayDevice, ServoLoop
from punctura.live import fit_conditioning, open_for, run_live
from punctura.record import RecordingError, open_recording, replay, replay_device
from punctura.scene.build import scene_text
from punctura.studio.loaded import from_tables, from_text
from recorded import run_to_end


def snapshots(device, scene, gate=None):
    """All ticks of an armed loop on a device that ends by itself."""
    loop = ServoLoop(device, scene, gate or GateLimits())
    listener = loop.listen(len(device))
    run_to_end(loop)
    return listener.read(len(device))


def forces(recording):
    return np.stack([recording.column(f"f{a}_N") for a in "xyz"], axis=1)


def test_a_recording_through_its_own_scene_gives_its_forces_tick_for_tick(start):
    run = start(ticks=8000).record()
    recording = open_recording(run.path)
    again = snapshots(replay_device(run.path, real_time=False), recording.info.scene)
    assert np.array_equal(again["tick"], recording.column("tick"))
    assert np.array_equal(again["time"], recording.column("time_s"))
    assert np.array_equal(again["force"], forces(recording)) and np.abs(again["force"]).max() > 0.1


def test_through_another_scene_the_same_motion_has_other_forces(start):
    run = start(ticks=4000).record()
    again = snapshots(replay_device(run.path, real_time=False), load_scene("k06-fig10"))
    recording = open_recording(run.path)
    assert np.array_equal(again["position"][:, 1], recording.column("y_m"))
    assert not np.array_equal(again["force"], forces(recording)) and again["depth"].shape == (4000, 1)


def test_it_passes_for_the_recorded_device(start):
    device = replay_device(start().record().path)
    info = device.info
    assert (info.backend, info.model, info.rate) == ("replay", "PHANTOM Omni, simulated, recorded", 1600.0)
    assert (info.max_force, info.continuous_force, info.encoder_step) == (3.3, 0.88, 0.055e-3)
    assert info.has_orientation and np.isnan(info.max_stiffness)
    assert fit_conditioning(load_scene("k06-fig12"), device)[0].servo.encoder_step == 0.055e-3
    assert (len(device), device.finished, device.behind) == (3000, False, 0)


def test_a_recording_that_was_not_finished_can_be_replayed(start):
    run = start()
    run.go()
    run.wait(lambda: run.recorder.status().rows == run.ticks)
    assert len(replay_device(run.recorder.status().file)) == run.ticks
    run.recorder.finish()


def test_a_live_run_on_it_ends_by_itself_and_has_every_tick(start):
    run = start(ticks=800).record()
    summary = run_live(open_for(run.loop.scene, f"replay:{run.path}"), run.loop.scene)
    assert (summary.ticks, summary.lost, summary.fault) == (800, 0, "")
    assert summary.statements[0] == "the force has no effect on a recorded motion"


def test_the_command_line_runs_a_recorded_motion_and_records_the_same_forces(start, tmp_path, punctura):
    run = start(ticks=1600).record()
    again = tmp_path / "again.parquet"
    command = ["run", "k06-fig12", "--headless", "--scene-filter", "--device", f"replay:{run.path}", "--json"]
    done = punctura(*command, "--record", again)
    assert done.status == 0, done.stderr
    assert json.loads(done.stdout)["device"] == "replay: PHANTOM Omni, simulated, recorded"
    assert np.array_equal(forces(open_recording(again)), forces(open_recording(run.path)))


def test_what_cannot_be_replayed_is_reported(start, tmp_path, punctura):
    with pytest.raises(DeviceError, match=r"replay:FILE\.parquet"):
        open_for(load_scene("k06-fig10"), "replay")
    done = punctura("run", "--headless", "--device", f"replay:{tmp_path / 'none.parquet'}")
    assert done.status == 2 and "there is no such file" in " ".join(done.stderr.split())
    with pytest.raises(RecordingError, match="holds no tick"):
        replay_device(start(ticks=0, capacity=64, name="empty.parquet").recorder.finish().file)
    path = start().record().path
    pq.write_table(pq.read_table(path).drop_columns(["sequence"]), path)
    with pytest.raises(RecordingError):
        replay_device(path)


def test_devices_says_that_replay_needs_a_recording(punctura):
    entry = next(e for e in json.loads(punctura("devices", "--json").stdout) if e["backend"] == "replay")
    assert entry["state"] == "no_device" and "replay:FILE.parquet" in entry["detail"]


def test_a_device_can_be_made_of_positions_alone():
    position = np.linspace([0, 5e-3, 0], [0, -5e-3, 0], 1000)
    device = ReplayDevice(position, [0, -1, 0], 1000, real_time=False)
    assert (device.info.model, device.info.rate) == ("a recorded motion", 1000.0)
    again = snapshots(device, load_scene("k06-fig10"))
    assert np.array_equal(again["position"], position) and np.array_equal(again["sequence"], np.arange(1000))
    assert np.array_equal(again["time"], np.arange(1000) / 1000) and again["healthy"].all()


def test_columns_of_another_length_and_a_rate_that_cannot_be_are_refused():
    two = np.zeros((2, 3))
    with pytest.raises(ValueError, match=r"buttons must have shape \(2,\)"):
        ReplayDevice(two, [0, -1, 0], 1600, buttons=[0])
    with pytest.raises(ValueError, match="axis"):
        ReplayDevice(two, np.zeros((3, 3)), 1600)
    with pytest.raises(ConfigurationError):
        ReplayDevice(two, [0, -1, 0], 0)


def wide_scene():
    scene = load_scene("k06-fig12")
    wall, profile = scene.membranes
    wall = wall.replace(
        tissue=Tissue("exponential", 500.0, tip_length=3e-3, tail_length=1e-3, tail_floor=0.4, cutting=0.2)
    )
    profile = profile.replace(tissue=Tissue(profile=[(0, 0, 0), (1.5e-3, -0.5, 0.05), (4e-3, -0.2, 0.1)], set=0.3))
    return scene.replace(
        membranes=[wall, profile],
        relaxation=[MaxwellBranch(100, 0.2), MaxwellBranch(40, 2)],
        servo=scene.servo.replace(sub_steps=3, conditioning="line_fit"),
    )


def test_a_recording_has_the_scene_and_replays_it(start):
    scene = wide_scene()
    run = start(ticks=8000, scene=scene)
    run.record()
    recording = open_recording(run.path)
    assert recording.info.scene.membranes == scene.membranes and recording.info.scene.relaxation == scene.relaxation
    result = replay(run.path)
    assert (result.ticks, result.identical, result.complete) == (8000, True, True)
    assert np.abs(recording.column("fy_N")).max() > 0.1


def test_a_change_between_plain_and_wide_replays(start):
    plain, wide = load_scene("k06-fig12"), wide_scene()
    run = start(ticks=6000, scene=plain, capacity=100_000)  # four runs without a clock, two in larger snapshots
    run.go()
    for scene in (wide, plain, wide):
        run.recorder.exchange(scene.replace(servo=plain.servo))
        run.go()
    run.recorder.finish()
    result = replay(run.path)
    assert (result.identical, result.complete) == (True, True), result.notes


def test_the_editor_gets_the_tables_and_gives_them_back():
    loaded = from_text(scene_text(wide_scene()))
    tables = json.loads(json.dumps(loaded.file.model_dump(mode="json", exclude_none=True)))
    assert tables["membrane"][1]["profile_depth_mm"] == [0.0, 1.5, 4.0]
    tables["membrane"][1]["profile_lower_N"][1] = -0.75
    assert from_tables(tables).scene.membranes[1].tissue.profile[1] == (1.5e-3, -0.75, 0.05)
