"""Too many ticks for the buffer: memory stays bounded, and each loss is counted and reported."""

import json

import pytest
from punctura import Scene, load_scene
from punctura._core import ServoLoop, SimulatedDevice
from punctura.live import room_note, run_live, strokes_through
from punctura.record import Recorder, open_recording
from punctura.scene import save_scene

SCENE = load_scene("k06-fig10")


def many(count=64, rate=100_000.0):
    """A valid scene with the given number of membranes."""
    first = SCENE.membranes[0]
    placed = [first.replace(name=f"membrane {i}", point=(0.0, -1e-4 * i, 0.0)) for i in range(count)]
    return Scene(SCENE.name, SCENE.needle, SCENE.coupling, placed, SCENE.servo.replace(rate=rate))


def device_for(scene, ticks):
    axis = scene.membranes[0].inward_normal
    rate = scene.servo.rate
    return SimulatedDevice(strokes_through(scene), rate=rate, axis=axis, real_time=False, ticks=ticks)


def test_a_summary_counts_every_tick_also_those_lost_after_the_last_that_was_read(monkeypatch):
    monkeypatch.setattr("punctura.live.session.POLL_S", 0.5)
    loops = []
    summary = run_live(device_for(SCENE, 300_000), SCENE, prepare=lambda loop: loops.append(loop) or (lambda: None))
    assert loops[0].report()["ticks"] == 300_000 == summary.ticks + summary.lost and summary.lost > 0


def test_a_scene_that_a_computer_may_not_keep_up_with_is_reported(tmp_path):
    assert room_note(ServoLoop(device_for(SCENE, 1), SCENE)) == ""
    scene = many()
    summary = run_live(device_for(scene, 100), scene)
    (note,) = [text for text in summary.statements if "64 membranes at 100000 Hz" in text]
    assert "Use fewer membranes or a lower rate" in note
    loop = ServoLoop(device_for(scene, 100), scene)
    with Recorder(loop, tmp_path / "run.parquet"):
        pass
    assert note in open_recording(tmp_path / "run.parquet").notes


@pytest.mark.parametrize("as_json", [False, True])
def test_the_command_line_has_the_note_before_the_run_and_in_the_json_only(punctura, tmp_path, as_json):
    save_scene(many(), tmp_path / "many.toml")
    run = ["run", tmp_path / "many.toml", "--headless", "--device", "simulated", "--duration", "0.1"]
    done = punctura(*run, *(["--json"] if as_json else []))
    assert "punctura: note: 64 membranes at 100000 Hz" in done.stderr
    listed = "\n".join(json.loads(done.stdout)["statements"]) if as_json else done.stdout
    assert ("64 membranes at 100000 Hz produce a lot of data" in listed) == as_json
