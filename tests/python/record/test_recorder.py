"""Every tick of a run reaches the file."""

import errno
import os
import sys
import threading
from contextlib import suppress

import numpy as np
import pytest
from punctura import load_scene
from punctura._core import GateLimits, ServoLoop, SimulatedDevice
from punctura.record import Recorder, RecordingError, open_recording
from waiting import wait_until

from .conftest import STROKES, Run


def policy_with_priority():
    """The scheduling of a thread that asks for real-time priority on this system."""
    found = []

    def ask():
        with suppress(OSError):
            os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(10))
        found.append(os.sched_getscheduler(0))

    thread = threading.Thread(target=ask)
    thread.start()
    thread.join()
    return found[0]


def test_a_busy_computer_has_half_a_minute_before_a_tick_is_lost(tmp_path):
    loop = ServoLoop(SimulatedDevice(STROKES, rate=1600), load_scene("k06-fig10"))
    with Recorder(loop, tmp_path / "run.parquet") as recorder:
        assert recorder._listener.capacity == 48_000
        wait_until(lambda: os.sched_getscheduler(recorder._reader.native_id) == policy_with_priority())


def test_the_file_holds_every_tick_and_every_number_of_it(start):
    run = start().record()
    seen, recording = run.witness.read(), open_recording(run.path)
    assert recording.finished and recording.rows == run.ticks and recording.lost == 0 and recording.notes == ()
    assert np.abs(seen["force"]).max() > 0.1
    expected = {"tick": seen["tick"], "time_s": seen["time"], "ceiling_N": seen["ceiling"], "state": seen["state"]}
    for k, a in enumerate("xyz"):
        expected |= {f"{a}_m": seen["position"][:, k], f"axis_{a}": seen["axis"][:, k]}
        expected |= {f"f{a}_N": seen["force"][:, k], f"model_f{a}_N": seen["model_force"][:, k]}
        expected |= {f"tip_{a}_m": seen["tip"][:, k]}
        for i in range(2):
            expected[f"proxy_{i}_{a}_m"] = seen["proxy"][:, i, k]
            expected[f"direction_{i}_{a}"] = seen["direction"][:, i, k]
    for i in range(2):
        expected |= {f"depth_{i}_m": seen["depth"][:, i], f"force_{i}_N": seen["axial_force"][:, i]}
        expected |= {f"lower_{i}_N": seen["lower"][:, i], f"upper_{i}_N": seen["upper"][:, i]}
        expected[f"phase_{i}"] = seen["phase"][:, i]
    for name in ("sequence", "buttons", "healthy", "motor_temperature", "fault", "commands", "ramp_limited"):
        expected[name] = seen[name]
    for name, column in expected.items():
        assert recording.column(name).astype(column.dtype).tobytes() == column.tobytes(), name


def test_phases_and_states_are_words(start):
    table = open_recording(start().record().path).table()
    assert set(table["phase_0"].to_pylist()) >= {"outside", "sticking", "sliding_in"}
    assert set(table["state"].to_pylist()) == {"active"}


def test_its_maker_may_say_more_of_a_run(tmp_path):
    loop = ServoLoop(SimulatedDevice(STROKES, real_time=False, ticks=100), load_scene("k06-fig12"))
    about = {"title": "Größe", "tables": {"needle": {"gauge": 21}}}
    with Recorder(loop, tmp_path / "run.parquet", about=about):
        assert open_recording(tmp_path / "run.parquet").info.about == about  # of a growing file, too
    assert open_recording(tmp_path / "run.parquet").info.about == about


def test_the_description_holds_scene_limits_device_and_build(start):
    gate = GateLimits(max_speed=32.0, dead_man=1)
    run = start(gate=gate).record()
    info = open_recording(run.path).info
    assert info.scene == load_scene("k06-fig12")
    assert info.gate == gate and info.limits == run.loop.limits
    assert info.data["device"]["backend"] == "simulated" and info.data["device"]["max_stiffness"] == "nan"
    assert info.data["rate_hz"] == 1600 and info.data["period_s"] == 1 / 1600
    assert info.build.startswith("punctura ") and "core " in info.build


def test_a_scene_is_recorded_at_the_devices_rate(start):
    run = start(device={"rate": 997.123456789}).record()
    assert open_recording(run.path).info.scene.servo.rate == 997.123456789


def test_a_recording_opens_while_it_grows(tmp_path):
    device = SimulatedDevice(STROKES)
    loop = ServoLoop(device, load_scene("k06-fig10"))
    with Recorder(loop, tmp_path / "run.parquet") as recorder:
        assert open_recording(tmp_path / "run.parquet").rows == 0
        loop.start()
        Run.wait(lambda: recorder.status().rows >= 400)
        growing = open_recording(tmp_path / "run.parquet")
        assert growing.rows >= 400 and not growing.finished and len(growing.table()) == growing.rows
        assert growing.notes == (f"the recording was not finished; it is complete up to tick {growing.rows - 1}",)
        loop.stop()
    assert recorder.status().finished and recorder.status().lost == 0
    assert sorted(p.name for p in tmp_path.iterdir()) == ["run.parquet"]


def test_a_run_without_a_tick_is_a_recording_too(start):
    run = start()
    assert run.recorder.finish().finished
    assert open_recording(run.path).rows == 0 and len(open_recording(run.path).table()) == 0


def test_a_fault_is_in_the_file_with_its_tick(start):
    run = start(gate=GateLimits(max_speed=0.032)).record()
    recording = open_recording(run.path)
    fault = recording.column("fault")
    (recorded,) = recording.faults
    assert recorded["fault"] == "position_jump" and recorded["tick"] == np.flatnonzero(fault)[0]
    assert "calibrate" in recorded["meaning"]


def test_a_ring_that_overflows_is_told_of_tick_by_tick(start):
    run = start(ticks=30_000, capacity=64).overflow()
    status, recording = run.recorder.status(), open_recording(run.path)
    assert status.lost_in_ring > 0 and status.rows + status.lost == 2 * run.ticks
    assert recording.rows == status.rows and recording.lost == status.lost
    tick, lost = recording.column("tick").astype(int), recording.column("lost").astype(int)
    assert (np.diff(tick, prepend=-1) - 1 == lost).all()
    assert lost.max() > 0 and lost.sum() + (2 * run.ticks - 1 - tick[-1]) == status.lost


def test_nothing_is_overwritten(start, tmp_path):
    run = start().record()
    with pytest.raises(RecordingError, match="overwrites no file"):
        start()
    run.path.rename(tmp_path / "run.parquet.part")
    with pytest.raises(RecordingError, match=r"punctura export .*run\.parquet\.part --out"):
        start()


@pytest.mark.parametrize(
    ("place", "reason"),
    [
        ("file/run.parquet", "Not a directory"),
        ("nowhere/run.parquet", "No such file"),
        ("run.csv", r"end in \.parquet"),
    ],
)
def test_a_place_that_cannot_be_written_is_told_before_the_run(start, tmp_path, place, reason):
    (tmp_path / "file").write_text("")
    with pytest.raises(RecordingError, match=reason):
        start(name=place)


@pytest.mark.skipif(sys.platform != "linux", reason="/proc is a folder that nobody can write to, on Linux only")
def test_a_folder_that_nobody_may_write_to_is_told_before_the_run(start):
    with pytest.raises(RecordingError, match="cannot be made"):
        start(name="/proc/run.parquet")


def test_a_disk_that_is_full_before_the_run_is_told_before_the_run(start, tmp_path, monkeypatch):
    def full(_file, _data):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr("punctura.record.append_file.AppendFile.write", full)
    with pytest.raises(RecordingError, match="cannot be written: No space left"):
        start()
    assert list(tmp_path.iterdir()) == []


def test_a_recorder_must_come_before_its_loop(tmp_path):
    loop = ServoLoop(SimulatedDevice(STROKES), load_scene("k06-fig10"))
    loop.start()
    with pytest.raises(RecordingError, match=r"before loop\.start"):
        Recorder(loop, tmp_path / "run.parquet")
    loop.stop()
