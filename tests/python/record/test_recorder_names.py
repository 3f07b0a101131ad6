"""The file of a killed process blocks its name only if it holds ticks or is still being written."""

import errno
import multiprocessing
import os
import subprocess
import sys

import pytest
from punctura.record import RecordingError, open_recording
from punctura.record.append_file import AppendFile
from punctura.record.new_file import in_use

KILLED = """
import os, signal, sys
import punctura.record.new_file as new_file
from punctura import load_scene
from punctura._core import ServoLoop, SimulatedDevice
from punctura.record import Recorder
from punctura.simulation import Strokes

def killed(*_):
    os.kill(os.getpid(), signal.SIGKILL)

at, named = sys.argv[2:]
if named == "named":
    new_file._unnamed = lambda folder: None
if at == "open":
    new_file.lock = killed  # the file is there, and nothing in it
loop = ServoLoop(SimulatedDevice(Strokes((0, 5e-3, 0), (0, -0.02, 0))), load_scene("k06-fig10"))
if at == "write":
    whole_write = os.write
    os.write = lambda descriptor, data: killed() if len(data) > 1000 else whole_write(descriptor, data)
Recorder(loop, sys.argv[1])
killed()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGKILL")
@pytest.mark.parametrize("named", ["named", "unnamed"])
@pytest.mark.parametrize("at", ["open", pytest.param("write", marks=pytest.mark.statistics), "begun"])
def test_a_kill_before_the_first_tick_blocks_no_name(start, tmp_path, at, named):
    path = tmp_path / "run.parquet"
    done = subprocess.run([sys.executable, "-c", KILLED, path, at, named], capture_output=True, text=True)
    assert done.returncode == -9, done.stderr
    if named == "unnamed" and at != "begun" and hasattr(os, "O_TMPFILE"):
        assert list(tmp_path.iterdir()) == []
    status = start(ticks=300).record().recorder.status()
    assert (status.finished, status.rows, status.lost) == (True, 300, 0)


def test_a_batch_that_was_being_written_when_the_process_was_killed_blocks_no_name(start, tmp_path):
    run = start(ticks=300)
    header = run.recorder.status().file.read_bytes()
    whole = run.killed(tmp_path / "killed").read_bytes()
    run.path.unlink()
    (tmp_path / "run.parquet.part").write_bytes(whole[: len(header) + (len(whole) - len(header)) // 2])
    assert open_recording(tmp_path / "run.parquet.part").rows == 0
    assert start(ticks=300).record().recorder.status().rows == 300


def test_one_that_is_being_written_blocks_its_name_until_it_is_closed(start):
    run = start()
    assert in_use(run.recorder.status().file)
    with pytest.raises(RecordingError, match="still running"):
        start()
    run.record()
    assert not in_use(run.path)


@pytest.mark.parametrize("content", [b"somebody else's", b"\xff\xff\xff\xff", bytes(100)])
def test_a_file_that_is_not_a_recording_is_left_alone(start, tmp_path, content):
    (tmp_path / "run.parquet.part").write_bytes(content)
    with pytest.raises(RecordingError, match="already exists"):
        start()
    assert (tmp_path / "run.parquet.part").read_bytes() == content


def test_a_file_with_a_tick_blocks_its_name(start, tmp_path):
    run = start(ticks=200)
    run.killed(tmp_path / "kept")
    run.path.unlink()
    (tmp_path / "kept").rename(tmp_path / "run.parquet.part")
    with pytest.raises(RecordingError, match=r"punctura export .*\.part --out"):
        start()


def test_a_link_to_an_empty_file_is_not_followed(start, tmp_path):
    (tmp_path / "empty").touch()
    try:
        (tmp_path / "run.parquet.part").symlink_to(tmp_path / "empty")
    except OSError:
        pytest.skip("this system makes no links")
    with pytest.raises(RecordingError, match="already exists"):
        start()
    assert (tmp_path / "empty").exists()


def contend(path, wins):
    while wins:  # a lost turn is repeated: a busy computer may hold the other process while it has the name
        try:
            file = AppendFile(path)  # empty, so that what it leaves is no obstacle
        except FileExistsError:
            continue
        assert file.change() is None, "two processes had the same name"
        file.close()
        wins -= 1


@pytest.mark.skipif(sys.platform == "win32", reason="Windows removes no file that another process has open")
def test_of_several_processes_that_take_over_a_name_one_has_it_at_a_time(tmp_path):
    context = multiprocessing.get_context("spawn")
    processes = [context.Process(target=contend, args=(tmp_path / "run.part", 100)) for _ in range(2)]
    for process in processes:
        process.start()
    for process in processes:
        process.join()
    assert [process.exitcode for process in processes] == [0, 0]


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells the present name of an open file")
def test_a_file_that_cannot_be_opened_by_its_name_is_closed_and_removed(tmp_path, monkeypatch):
    path, whole_open = tmp_path / "run.part", os.open

    def too_many(name, flags, *more, **named):
        if flags == os.O_PATH:
            raise OSError(errno.EMFILE, os.strerror(errno.EMFILE))
        return whole_open(name, flags, *more, **named)

    before = len(os.listdir("/proc/self/fd"))
    with monkeypatch.context() as patch:
        patch.setattr(os, "open", too_many)
        with pytest.raises(OSError, match=os.strerror(errno.EMFILE)):
            AppendFile(path, b"the beginning")
    assert not path.exists() and len(os.listdir("/proc/self/fd")) == before
    AppendFile(path).close()


def test_a_damaged_file_without_a_readable_tick_is_renamed_and_reported(start, tmp_path):
    run = start(ticks=300)
    header = run.recorder.status().file.read_bytes()
    damaged = bytearray(run.killed(tmp_path / "killed").read_bytes())
    run.path.unlink()
    damaged[len(header) : len(header) + 64] = bytes(range(64))
    (tmp_path / "run.parquet.part").write_bytes(damaged)
    status = start(ticks=300).record().recorder.status()
    (aside,) = tmp_path.glob("*.damaged")
    assert aside.read_bytes() == damaged and status.finished and status.rows == 300
    assert any(str(aside) in note for note in open_recording(status.file).notes)
