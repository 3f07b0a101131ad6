"""Finished, killed, cut off and damaged recordings."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from punctura import load_scene
from punctura.record import RecordingError, open_recording, replay_device
from punctura.record.recording import read_found, read_recording
from recorded import assert_same_table

TOOLS = Path(__file__).parents[3] / "tools"


@pytest.fixture
def growing(start, tmp_path):
    """A recording of 3000 ticks as a killed process leaves it."""
    return start().killed(tmp_path / "killed.part")


def test_a_killed_recording_has_what_the_finished_one_has(growing, tmp_path):
    killed, finished = open_recording(growing), open_recording(tmp_path / "run.parquet")
    assert_same_table(killed.table(), finished.table())
    assert killed.info.scene == finished.info.scene == load_scene("k06-fig12")
    assert not killed.finished and finished.finished


@pytest.mark.parametrize("share", [0.0, 0.001, 0.2, 0.5, 0.9, 0.999])
def test_a_file_that_is_cut_off_has_what_was_whole(growing, share):
    data, all_ticks = growing.read_bytes(), open_recording(growing).rows
    growing.write_bytes(data[: int(share * len(data))])
    if share < 0.1:
        with pytest.raises(RecordingError, match="not a recording of Punctura, or its beginning is damaged"):
            open_recording(growing)
        return
    recording = open_recording(growing)
    assert recording.rows <= all_ticks and (recording.column("tick") == np.arange(recording.rows)).all()
    assert len(recording.notes) == 1


def test_a_flipped_bit_costs_its_batch_and_is_reported(start, tmp_path, monkeypatch):
    monkeypatch.setattr("punctura.record.recorder._ROWS_AT_ONCE", 500)
    run = start()
    run.go()
    run.wait(lambda: run.recorder.status().rows == run.ticks)
    kept = tmp_path / "killed.part"
    data = bytearray(run.recorder.status().file.read_bytes())
    run.recorder.finish()
    value = open_recording(run.path).table()["time_s"][1234].as_py()
    data[data.index(np.float64(value).tobytes())] ^= 1  # in the third batch: no other tick has this time
    kept.write_bytes(data)
    recording = open_recording(kept)
    assert recording.lost == 500 and recording.rows == 2500
    assert "1 damaged parts of the file were left out" in " ".join(recording.notes)
    assert 1234 not in recording.column("tick")


@pytest.mark.parametrize("there", [".part", ""])
@pytest.mark.parametrize("asked", [".part", ""])
def test_a_recording_is_read_by_its_path_and_by_that_of_its_part_file(start, tmp_path, there, asked):
    kept = start(300).killed(tmp_path / f"kept.parquet{there}")
    assert read_recording(tmp_path / f"kept.parquet{asked}", lambda one: (one.path, one.rows)) == (kept, 300)


def test_a_recording_is_read_again_only_at_another_path(tmp_path):
    tried = []

    def fail(path):
        tried.append(path.name)
        raise RecordingError(f"{path.name} is damaged")

    with pytest.raises(RecordingError, match="one is damaged"):
        read_found(lambda: tmp_path / "one", fail)
    paths = iter([tmp_path / "one", tmp_path / "two"])
    with pytest.raises(RecordingError, match="two is damaged"):
        read_found(lambda: next(paths), fail)
    assert tried == ["one", "one", "two"]


def test_other_files_are_told_from_recordings(tmp_path):
    text = tmp_path / "notes.txt"
    text.write_text("no recording")
    for path, reason in [
        (text, "not a recording"),
        (tmp_path / "gone.parquet", "there is no such file"),
        (tmp_path, "is a folder"),
    ]:
        with pytest.raises(RecordingError, match=reason):
            open_recording(path)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes")
def test_a_pipe_is_refused_before_it_is_opened(tmp_path):
    pipe = tmp_path / "pipe.parquet"
    os.mkfifo(pipe)
    for opens in (open_recording, replay_device):
        with pytest.raises(RecordingError, match="is a pipe or a device, not a recording"):
            opens(pipe)


def test_a_column_that_is_not_there_is_told_with_those_that_are(start):
    with pytest.raises(RecordingError, match=r"no column 'fx'; it has tick, time_s, x_m.*fx_N"):
        open_recording(start().record().path).column("fx")


@pytest.mark.statistics
def test_spoilt_files_crash_nothing_and_give_no_wrong_number():
    done = subprocess.run(
        [sys.executable, TOOLS / "fuzz_recordings.py", "--minutes", "0.05"], capture_output=True, text=True
    )
    assert done.returncode == 0 and "no wrong number" in done.stdout, done.stdout + done.stderr


@pytest.mark.statistics
def test_killed_at_random_moments_every_file_opens_and_lacks_half_a_second_at_most():
    done = subprocess.run([sys.executable, TOOLS / "soak_recorder.py", "--kills", "8"], capture_output=True, text=True)
    assert done.returncode == 0 and "8 kills, 0 failed, 0 names blocked" in done.stdout, done.stdout + done.stderr
