"""The force scale in a live run: what the hand gets, and what recordings, exports and the summary tell of it."""

import numpy as np
import punctura as pn
import pyarrow.parquet as pq
import pytest
from punctura._core import ServoLoop
from punctura.cli._headless import begun, in_words, status_text
from punctura.live import RunSummary, ServoState, SimulatedDevice, felt_force
from punctura.record import Recorder, export, open_recording, replay, replay_device
from punctura.scene import DisplaySettings
from punctura.simulation import Strokes
from punctura.studio.recorded import tick_frames
from recorded import recorded, run_to_end
from waiting import wait_until

TICKS = 4800
STROKES = Strokes((0, 5e-3, 0), (0, -0.02, 0), count=2, duration=0.8, rest=0.6)


def scaled(force_scale):
    return pn.load_scene("k06-fig12").replace(display=DisplaySettings(force_scale))


def device(ticks=TICKS):
    return SimulatedDevice(STROKES, real_time=False, ticks=ticks)


def test_the_hand_gets_the_scaled_force_and_the_recording_has_both(tmp_path):
    recording = open_recording(recorded(tmp_path / "run.parquet", device(), scaled(0.3), TICKS))
    ticks = recording.ticks()
    assert (ticks.force_scale == 0.3).all()
    free = (ticks.limit == 0) & (ticks.state == ServoState.active)
    assert free.sum() > TICKS / 2 and np.abs(ticks.model_force[free]).max() > 0.5
    np.testing.assert_array_equal(ticks.force[free], 0.3 * ticks.model_force[free])
    assert recording.info.scene.display.force_scale == 0.3
    export(tmp_path / "run.parquet", tmp_path / "run.csv")
    head = (tmp_path / "run.csv").read_text().split("\n", 1)[0].split(",")
    assert {"fx_N", "model_fx_N", "force_scale"} <= set(head)


@pytest.mark.parametrize("force_scale", [0.3, "automatic"])
def test_a_scaled_run_is_replayed_to_the_last_bit(tmp_path, force_scale):
    path = recorded(tmp_path / "run.parquet", device(), scaled(force_scale), TICKS)
    result = replay(path)
    assert (result.ticks, result.identical, result.complete) == (TICKS, True, True)


def test_another_scale_while_the_run_goes_on_is_replayed_to_the_last_bit(tmp_path):
    loop = ServoLoop(device(0), scaled(1))
    recorder = Recorder(loop, tmp_path / "run.parquet", 1 << 16)
    loop.arm()
    loop.start()
    wait_until(lambda: loop.report()["ticks"] > 2000)
    assert loop.force_scale == 1
    recorder.exchange(scaled(0.25))
    assert loop.force_scale == 0.25
    begin = loop.report()["ticks"]
    wait_until(lambda: loop.report()["ticks"] > begin + 2000)
    loop.stop()
    assert recorder.finish().lost == 0
    assert set(open_recording(tmp_path / "run.parquet").column("force_scale")) == {1, 0.25}
    result = replay(tmp_path / "run.parquet")
    assert result.identical and result.complete


@pytest.mark.parametrize("more", [[], ["thumb", "plunger", "thumb_force", "thumb_felt", "pressure", "injected"]])
def test_a_recording_without_the_column_gave_the_whole_force(tmp_path, more):
    path = recorded(tmp_path / "run.parquet", device(), scaled(1), TICKS)
    from punctura.record.header import KEY, with_check_sum

    table = pq.read_table(path)
    later = [name for name in table.column_names if name.rsplit("_", 1)[0] in more]
    assert len(later) == len(more)
    table = table.drop_columns(["force_scale", *later])
    old = table.replace_schema_metadata(None)
    text = pq.read_schema(path).metadata[KEY]
    pq.write_table(old.replace_schema_metadata(with_check_sum(text, old.schema)), path)
    ticks = open_recording(path).ticks()
    assert (ticks.force_scale == 1).all() and (ticks.thumb == 0).all() and np.isnan(ticks.plunger).all()
    assert list(tick_frames(open_recording(path))), "the page can show it"
    result = replay(path)
    assert (result.ticks, result.identical, result.complete) == (TICKS, True, True)
    again = ServoLoop(replay_device(path, real_time=False), scaled(1))
    run_to_end(again)
    assert again.report()["ticks"] >= TICKS


def test_the_simulation_gives_the_models_newtons():
    path = np.linspace(-1e-3, 9e-3, 3200)
    assert np.array_equal(pn.simulate(scaled(1), path).force, pn.simulate(scaled(0.3), path).force)


def test_the_terminal_tells_the_scale_wherever_it_tells_a_force():
    loop = ServoLoop(device(), scaled(0.3))
    listener = loop.listen()
    assert "felt force (x 0.30)" in begun("scene", loop, loop.device)
    run_to_end(loop)
    summary = RunSummary.of(loop.scene, "simulated", 1600)
    summary.add(listener.read())
    assert summary.felt_peak_N <= 0.3 * summary.peak_N * (1 + 1e-12)
    assert f"strongest felt force (x 0.30) {summary.felt_peak_N:.3g} N, strongest model force " in in_words(summary)
    assert "felt force (x 0.30) +" in status_text(summary)
    assert felt_force(1) == "felt force" and felt_force(0.0664) == "felt force (x 0.066)"
