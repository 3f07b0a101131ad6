"""A replay gives the recorded forces, bit for bit."""

import json
import shutil

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from punctura import ConfigurationError, load_scene
from punctura._core import FedDevice, GateLimits, ServoLoop
from punctura.record import Recorder, RecordingError, export, open_recording, replay
from punctura.record.header import to_metadata
from punctura.ticks.fields import file_column
from recorded import assert_same_table


def test_a_minute_at_1600_hz_is_identical(start):
    run = start(ticks=48_000)  # twice: the ring does not hold 96,000
    run.go()
    run.wait(lambda: run.recorder.status().rows == 48_000)
    run.record()
    assert run.recorder.status().lost == 0
    result = replay(run.path)
    assert (result.ticks, result.identical, result.complete, result.notes) == (96_000, True, True, [])
    assert np.abs(open_recording(run.path).column("fy_N")).max() > 0.1


def test_scenes_commands_and_faults_are_obeyed_again_at_their_ticks(tmp_path):
    """The test feeds the device itself, so the number of ticks does not depend on the load of the machine."""
    first, wider = load_scene("k06-fig12"), load_scene("epidural")
    device = FedDevice(1600, real_time=False)
    loop = ServoLoop(device, first)
    recorder = Recorder(loop, tmp_path / "run.parquet")
    heights = iter(-5e-3 + 10e-3 * np.cos(np.arange(1000) * 2 * np.pi / 150))  # m; in and out of the tissue

    def tick_on(n, healthy=True):
        for _ in range(n):
            device.feed((0, next(heights), 0), (0, -1, 0), healthy=healthy)

    recorder.exchange(wider)  # before the first tick: taken by it
    recorder.exchange(first)
    loop.arm()
    loop.start()
    tick_on(200)
    recorder.exchange(wider)
    tick_on(200)
    loop.pause()
    tick_on(99)
    tick_on(1, healthy=False)
    loop.reset()
    tick_on(10)
    loop.arm()
    recorder.exchange(first)
    tick_on(200)
    loop.stop()
    status = recorder.finish()
    recording = open_recording(tmp_path / "run.parquet")
    commands = recording.column("commands")
    assert status.lost == 0 and (commands & 8 != 0).sum() == 3 and np.bitwise_or.reduce(commands) == 15
    scenes = [row for row in recording.table()["new_scenes"].to_pylist() if row]
    assert [len(row) for row in scenes] == [2, 1, 1]
    last = len(wider.membranes) - 1
    assert recording.table()[f"phase_{last}"].null_count > 0
    assert np.abs(recording.column("fy_N")).max() > 0.1 and len(recording.faults) == 1
    result = replay(tmp_path / "run.parquet")
    assert result.identical and result.complete and result.ticks == recording.rows == 710


def test_a_fault_and_what_follows_it_are_identical(start):
    run = start(gate=GateLimits(max_speed=0.032)).record()
    assert len(open_recording(run.path).faults) == 1
    assert replay(run.path).identical


def test_a_killed_recording_can_be_run_again(start, tmp_path):
    run = start()
    run.go()
    run.wait(lambda: run.recorder.status().rows == run.ticks)
    shutil.copy(run.recorder.status().file, tmp_path / "killed.part")
    run.recorder.finish()
    result = replay(tmp_path / "killed.part")
    assert result.identical and result.ticks == run.ticks


def changed(path, column, tick, change):
    """The recording with one number changed."""
    table = pq.read_table(path)
    values = table[column].to_pylist()
    values[tick] = change(values[tick])
    index = table.schema.get_field_index(column)
    pq.write_table(table.set_column(index, table.field(column), pa.array(values, table.field(column).type)), path)
    return path


@pytest.mark.parametrize("column", ["fy_N", "depth_0_m", "ceiling_N"])
def test_the_last_bit_of_one_number_is_found(start, column):
    path = changed(start().record().path, column, 1234, lambda x: np.nextafter(x, 9.0))
    result = replay(path)
    assert not result.identical and result.first_difference["tick"] == 1234
    assert result.first_difference["column"] == column


def test_another_input_gives_another_force_from_its_tick_on(start):
    path = changed(start().record().path, "y_m", 1000, lambda y: y + 1e-6)
    assert replay(path).first_difference["tick"] == 1000


def test_a_replay_ends_where_ticks_are_missing(start):
    run = start(ticks=30_000, capacity=64).overflow()
    result = replay(run.path)
    assert result.identical and not result.complete and 0 < result.ticks < run.ticks
    assert "came faster than they could be read" in result.notes[0] and "are missing before tick" in result.notes[1]


def test_ticks_that_are_missing_at_the_end_are_noted(start, monkeypatch):
    monkeypatch.setattr("punctura.record.recorder.INTERVAL_S", 60)  # the ring is read once, at the end
    result = replay(start(ticks=30_000, capacity=64).record().path)
    assert result.identical and "ticks are missing at the end" in result.notes[-1]


def test_a_scene_that_came_past_the_recorder_is_reported(start):
    run = start()
    run.loop.exchange(load_scene("k06-fig10"))
    run.record()
    result = replay(run.path)
    assert not result.complete and "change scenes through Recorder.exchange" in result.notes[0]


def test_the_second_run_of_a_loop_begins_in_a_state_that_is_not_known(start, tmp_path):
    from punctura.record import Recorder

    run = start().record()
    run.loop.start()
    run.loop.stop()
    with Recorder(run.loop, tmp_path / "second.parquet", 8192) as second:
        run.loop.start()
        run.wait(lambda: second.status().rows > 0)
        run.loop.stop()
    result = replay(tmp_path / "second.parquet")
    assert second.status().lost == 0 and result.ticks == 0 and "the recording begins at tick" in result.notes[0]


def test_another_build_is_noted(start, monkeypatch):
    run = start().record()
    monkeypatch.setattr("punctura.record.run_again.build_id", lambda: "punctura 9.9")
    result = replay(run.path)
    assert result.identical and not result.same_build and "another build" in result.notes[0]


def test_a_file_without_the_inputs_is_refused(start):
    path = start().record().path
    pq.write_table(pq.read_table(path).drop_columns(["sequence"]), path)
    with pytest.raises(RecordingError):
        replay(path)


def test_the_command_says_identical_and_writes_the_computed_ticks(start, tmp_path, punctura):
    run = start().record()
    done = punctura("replay", run.path, "--out", tmp_path / "again.parquet")
    assert done.status == 0 and "3000 ticks, identical" in done.stdout
    again, first = open_recording(tmp_path / "again.parquet"), open_recording(run.path)
    assert_same_table(again.table(), first.table())
    assert again.rows == 3000


def test_the_command_says_what_differs(start, punctura):
    path = changed(start().record().path, "fy_N", 7, lambda x: 1.0)
    done = punctura("replay", path)
    assert done.status == 1 and "differs first at tick 7: fy_N was 1.0" in done.stdout
    assert json.loads(punctura("replay", path, "--json").stdout)["first_difference"]["tick"] == 7


def test_a_recording_without_a_tick_is_not_called_identical(start, punctura):
    run = start(ticks=0, capacity=64)
    assert run.recorder.finish().finished
    result = replay(run.path)
    assert result.ticks == 0 and not result.complete and "nothing to replay" in result.notes[-1]
    done = punctura("replay", run.path)
    assert done.status == 1 and "nothing was compared" in done.stdout and "identical" not in done.stdout
    assert "holds no ticks; nothing to replay" in done.stderr


def test_a_file_that_is_damaged_inside_is_not_called_identical(start, tmp_path):
    """A flipped bit in the length of a part: the rest of the file, which is most of it, cannot be found."""
    kept = tmp_path / "kept.parquet.part"
    start(ticks=20_000).killed(kept)
    data = bytearray(kept.read_bytes())
    third = len(data) // 3
    at = data.index(b"crc32", third) - 104
    data[at : at + 8] = b"\xff" * 8
    kept.write_bytes(data)
    recording = open_recording(kept)
    assert recording.damaged and 0 < recording.rows < 15_000
    result = replay(kept)
    assert result.identical and not result.complete
    assert any("damaged" in note for note in result.notes)
    out = tmp_path / "saved.parquet"
    export(kept, out)
    assert open_recording(out).damaged and not replay(out).complete


def test_the_computed_ticks_overwrite_no_recording(start, tmp_path):
    run = start(ticks=500).record()
    other = tmp_path / "other.parquet"
    shutil.copy(run.path, other)
    before = other.read_bytes()
    for out, words in (
        (run.path, "is the recording itself"),
        (other, "is already a recording"),
        (tmp_path / "x.csv", "must end in .parquet"),
        (tmp_path / "no" / "x.parquet", "there is no folder"),
    ):
        with pytest.raises(ConfigurationError, match=words):
            replay(run.path, out)
    with pytest.raises(ConfigurationError, match="is already a recording"):
        export(run.path, other)
    assert other.read_bytes() == before


def test_a_recording_without_the_columns_of_a_membrane_is_refused(start, tmp_path):
    run = start(ticks=1600)
    run.go()
    run.wait(lambda: run.recorder.status().rows == 1600)
    run.record()
    whole = pq.read_table(run.path)
    last = len(open_recording(run.path).info.scene.membranes) - 1
    kept = [name for name in whole.schema.names if not ((field := file_column(name)) and field.membrane == last)]
    assert len(kept) < len(whole.schema.names)
    narrow, data = whole.select(kept), open_recording(run.path).info.data
    pq.write_table(narrow.replace_schema_metadata(to_metadata(data, narrow.schema)), tmp_path / "narrow.parquet")
    with pytest.raises(RecordingError, match="columns were removed"):
        replay(tmp_path / "narrow.parquet")
