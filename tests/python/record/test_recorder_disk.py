"""A full, slow or failing disk has little effect on a recording, which is reported, and none on the loop."""

import errno
import os
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from punctura.record import open_recording
from punctura.record.append_file import AppendFile
from waiting import PATIENCE_S

FULL = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
whole_write = AppendFile.write


@pytest.fixture
def disk(monkeypatch):
    """Replaces the file's write by a function, with a short retry interval; `recovers`: before the tries at the end are
    over, however busy the computer is.
    """

    def behave(write, recovers=False):
        monkeypatch.setattr(AppendFile, "write", write)
        monkeypatch.setattr("punctura.record.writer.RETRY_S", 0.01)
        monkeypatch.setattr("punctura.record.writer.LAST_TRIES_S", PATIENCE_S if recovers else 0.1)

    return behave


def torn(self, data):
    """Writes half of the bytes, then the disk is full."""
    os.lseek(self._descriptor, self.size, os.SEEK_SET)
    os.write(self._descriptor, data[: len(data) // 2])
    raise FULL


def test_a_disk_that_is_full_for_a_while_costs_no_tick(start, disk):
    failures = []

    def write(self, data):
        if self.size and len(failures) < 5:
            failures.append(len(data))
            torn(self, data)
        whole_write(self, data)

    disk(write, recovers=True)
    run = start()
    run.go()
    status = run.recorder.finish()
    assert len(failures) >= 1 and status.finished and status.lost == 0
    assert any("No space left" in note and "resolved after" in note for note in status.notes)
    assert open_recording(run.path).rows == run.ticks


def test_on_a_disk_that_stays_full_the_file_is_readable_up_to_there_and_the_rest_is_counted(start, disk):
    def write(self, data):
        if self.size > 500_000:
            torn(self, data)
        whole_write(self, data)

    disk(write)
    run = start(ticks=20_000)
    run.go()
    assert run.loop.report()["ticks"] == 20_000
    status = run.recorder.finish()
    assert not status.finished and "No space left" in status.trouble and "readable up to tick" in status.trouble
    assert "writing goes on" not in status.trouble  # it is over
    assert 0 < status.rows < 20_000 and status.rows + status.lost == 20_000
    cause = os.strerror(errno.ENOSPC)
    assert status.unwritten == {cause: status.lost}
    assert status.notes[-1] == f"{status.lost} of 20000 ticks are lost: {status.lost} could not be written: {cause}"
    recording = open_recording(run.path)
    assert recording.rows == status.rows and recording.column("tick")[-1] == status.last_tick


def test_ticks_that_do_not_fit_in_memory_are_counted_as_missing(start, disk, monkeypatch):
    monkeypatch.setattr("punctura.record.recorder._BACKLOG_BYTES", 2_000_000)
    monkeypatch.setattr("punctura.record.recorder._ROWS_AT_ONCE", 500)
    gate = []

    def write(self, data):
        if self.size and not gate:
            raise FULL
        whole_write(self, data)

    disk(write)
    run = start(ticks=16_000)
    run.go()
    run.wait(lambda: run.recorder.status().lost_in_backlog > 0)
    run.wait(lambda: "No space left" in run.recorder.status().trouble)
    gate.append("open")
    status = run.recorder.finish()
    assert status.finished and status.lost_in_ring == 0 and status.rows + status.lost == run.ticks
    assert open_recording(run.path).lost == status.lost
    assert open_recording(run.path).info.data["lost"] == {"ring": 0, "backlog": status.lost, "other": 0}


def test_ticks_that_a_slow_disk_costs_are_told_as_such(start, disk, monkeypatch):
    monkeypatch.setattr("punctura.record.recorder._BACKLOG_BYTES", 2_000_000)
    monkeypatch.setattr("punctura.record.recorder._ROWS_AT_ONCE", 500)
    taken = threading.Event()

    def write(self, data):
        if self.size:
            assert taken.wait(PATIENCE_S)
        whole_write(self, data)

    disk(write)
    run = start(ticks=16_000)
    run.go()
    run.wait(lambda: run.recorder.status().lost_in_backlog > 0)
    taken.set()
    status = run.recorder.finish()
    assert status.finished and status.unwritten == {"the disk was too slow": status.lost}
    assert status.notes[-1].endswith(f"{status.lost} could not be written: the disk was too slow")


def test_a_slow_disk_loses_nothing(start, disk):
    def write(self, data):
        time.sleep(0.2)
        whole_write(self, data)

    disk(write)
    run = start(ticks=8000)
    run.go()
    status = run.recorder.finish()
    assert status.finished and status.lost == 0 and status.slowest_write_s >= 0.2
    assert (open_recording(run.path).column("tick") == np.arange(8000)).all()


def test_a_parquet_file_that_cannot_be_written_leaves_the_recording_where_it_is(start, monkeypatch):
    def full(*_args, **_more):
        raise FULL

    monkeypatch.setattr("punctura.record.finish.parquet_output", full)
    run = start()
    run.go()
    status = run.recorder.finish()
    assert not status.finished and "conversion to Parquet failed" in status.trouble
    assert open_recording(run.path).rows == run.ticks
    assert str(status.file) in status.trouble and status.file.name == "run.parquet.part"


LIMITED = """
import resource, sys, time
from punctura import load_scene
from punctura._core import ServoLoop, SimulatedDevice
from punctura.record import Recorder
from punctura.simulation import Strokes
resource.setrlimit(resource.RLIMIT_FSIZE, (300_000, 300_000))
device = SimulatedDevice(Strokes((0, 5e-3, 0), (0, -0.02, 0)), real_time=False, ticks=20_000)
loop = ServoLoop(device, load_scene("k06-fig12"))
with Recorder(loop, sys.argv[1], 20_000) as recorder:
    loop.start()
    while not device.finished:
        time.sleep(1e-3)
    loop.stop()
print(loop.report()["ticks"], recorder.status().rows, recorder.status().lost, recorder.status().trouble)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows sets no limit on the size of a file")
def test_a_limit_of_the_system_on_the_file_is_a_full_disk(tmp_path):
    path = tmp_path / "run.parquet"
    done = subprocess.run([sys.executable, "-c", LIMITED, path], capture_output=True, text=True, check=True)
    ticks, rows, lost, trouble = done.stdout.split(maxsplit=3)
    assert int(ticks) == 20_000 and int(rows) + int(lost) == 20_000 and "File too large" in trouble
    assert open_recording(path).rows == int(rows)
