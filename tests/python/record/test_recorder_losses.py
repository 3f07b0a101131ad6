"""After any failure of a recording, every tick is a row or is counted as lost, and the failure is reported."""

import errno
import os
import re
import shlex
import sys

import pytest
from punctura.record import Recorder, RecordingError, finish, open_recording
from punctura.record.stream import Decoder, Encoder


def all_counted(run, status):
    """Rows plus losses equal the number of ticks, in the status and in the file."""
    made = run.loop.report()["ticks"]
    assert status.rows + status.lost == made and f"{status.lost} of {made} ticks are lost" in status.notes[-1]
    if status.rows:
        recording = open_recording(status.file)
        assert recording.rows == status.rows
        if status.finished:
            assert recording.lost == status.lost and sum(recording.info.header.lost.values()) == status.lost
    return status


class Failing:
    """Replaces a function. Fails at the calls with the given numbers."""

    def __init__(self, function, error, calls):
        self.function, self.error, self.calls, self.count = function, error, calls, 0

    def __call__(self, *arguments):
        self.count += 1
        if self.count in self.calls:
            raise self.error
        return self.function(*arguments)


@pytest.mark.parametrize("error", [MemoryError(), RuntimeError("a defect"), SystemExit()], ids=repr)
@pytest.mark.parametrize("place", ["read", "keep", "encode"])
def test_an_error_in_the_reading_thread_costs_ticks_that_are_counted(start, monkeypatch, place, error):
    monkeypatch.setattr("punctura.record.recorder._ROWS_AT_ONCE", 500)
    run = start(ticks=4801)
    failing = Failing(None, error, range(3, 6))
    if place == "encode":
        failing.function = Encoder.batch
        monkeypatch.setattr(Encoder, "batch", lambda self, batch: failing(self, batch))
    elif place == "keep":
        failing.function = run.recorder._keep
        run.recorder._keep = failing
    else:
        failing.function = run.recorder._listener.read
        run.recorder._listener = Reader(run.recorder._listener, failing)
    run.go()
    run.wait(lambda: run.recorder.status().rows > 0 and failing.count >= 6)
    words = "not enough memory" if isinstance(error, MemoryError) else "please report it"
    assert words in run.recorder.status().trouble
    status = all_counted(run, run.recorder.finish())
    assert status.finished and 0 < status.lost < 4801 and any(words in note for note in status.notes)


class Reader:
    """A listener that loses the ticks of a failed read."""

    def __init__(self, listener, failing):
        self._listener, self._failing = listener, failing

    @property
    def lost(self):
        return self._listener.lost

    def read(self, limit):
        columns = self._failing.function(limit)
        self._failing.function = lambda _: columns
        try:
            return self._failing(limit)
        finally:
            self._failing.function = self._listener.read


def test_ticks_that_never_leave_the_ring_are_counted(start):
    run = start(ticks=3000)

    def fail(_limit):
        raise MemoryError

    run.recorder._listener.read(0)
    run.recorder._listener = Reader(run.recorder._listener, Failing(fail, None, ()))
    run.recorder._listener.read = fail
    run.go()
    run.wait(lambda: "memory" in run.recorder.status().trouble)
    status = all_counted(run, run.recorder.finish())
    assert status.lost == status.lost_other == 3000


def remove(run):
    run.part.unlink()


def replace(run):
    run.part.with_name("other").write_bytes(b"another file")
    run.part.with_name("other").replace(run.part)


def cut(run):
    os.truncate(run.part, run.part.stat().st_size // 2)


def empty(run):
    os.truncate(run.part, 0)


@pytest.fixture
def begun(start, monkeypatch):
    """A recording with ticks on the disk, whose file another program changes before more ticks come."""
    monkeypatch.setattr("punctura.record.recorder._ROWS_AT_ONCE", 500)

    def go(meddle, **more):
        run = start(ticks=2000, **more)
        run.part = run.recorder.status().file
        run.go()
        run.wait(lambda: run.recorder.status().rows == 2000)
        meddle(run)
        run.go()
        return run

    return go


on_posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows lets nobody remove or move a file that is open")


@on_posix
@pytest.mark.parametrize(
    ("meddle", "words"),
    [(remove, "removed or replaced"), (replace, "removed or replaced"), (cut, "truncated"), (empty, "truncated")],
)
def test_a_file_that_is_removed_or_changed_is_told_while_it_runs(begun, meddle, words):
    run = begun(meddle)
    run.wait(lambda: words in run.recorder.status().trouble)
    assert run.recorder.status().lost == 2000 - run.recorder.status().rows > 0
    status = run.recorder.finish()
    assert words in status.trouble and not status.finished and not run.path.exists()
    all_counted(run, status)
    if meddle is cut:
        assert 0 < status.rows < 2000 and f"readable up to tick {status.rows - 1}" in status.trouble
    else:
        assert (
            status.rows == 0 and status.lost == 4000 and status.trouble.endswith("no tick of the recording can be read")
        )
    assert "memory" not in status.notes[-1]
    (cause,) = status.unwritten
    assert words in cause and status.unwritten[cause] == 2000


@on_posix
@pytest.mark.parametrize(("meddle", "words"), [(remove, "removed or replaced"), (cut, "truncated")])
def test_a_file_that_is_removed_after_the_last_tick_is_not_called_whole(start, meddle, words):
    run = start(ticks=2000)
    run.part = run.recorder.status().file
    run.go()
    run.wait(lambda: run.recorder.status().rows == 2000)
    meddle(run)
    status = all_counted(run, run.recorder.finish())
    assert words in status.trouble and not status.finished and status.lost > 0


@on_posix
def test_a_folder_that_is_moved_is_told_while_it_runs_and_its_file_is_whole(begun, tmp_path):
    (tmp_path / "here").mkdir()
    run = begun(lambda _: (tmp_path / "here").rename(tmp_path / "there"), name="here/run.parquet")
    run.wait(lambda: "was moved during the recording" in run.recorder.status().trouble)
    status = run.recorder.finish()
    assert "was moved" in status.trouble and not status.finished
    there = tmp_path / "there" / "run.parquet.part"
    assert open_recording(there).rows == 4000
    if sys.platform == "linux":  # where the system tells the way to an open file
        assert status.file == there and (status.rows, status.lost) == (4000, 0) and str(there) in status.trouble


on_linux = pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells the present name of an open file")


@on_linux
def test_a_file_that_is_renamed_is_told_by_its_present_name_and_the_remedy_works(begun, punctura):
    run = begun(lambda run: run.part.rename(run.part.with_name("first")))
    aside = run.part.with_name("put aside.parquet.part")
    run.wait(lambda: f"recording continues in {run.part.with_name('first')}" in run.recorder.status().trouble)
    assert run.recorder.status().file == run.part.with_name("first")
    run.part.with_name("first").rename(aside)  # and a second time
    status = run.recorder.finish()
    assert not status.finished and (status.rows, status.lost) == (4000, 0) and status.file == aside
    remedy = re.search(r"run: punctura (export .+) --out FILE.parquet", status.trouble)
    assert remedy and str(run.part) not in remedy[0]
    assert punctura(*shlex.split(remedy[1]), "--out", run.path).status == 0
    assert open_recording(run.path).rows == 4000


@on_linux
def test_where_the_present_name_is_not_known_no_path_is_given(begun):
    aside = []

    def move(run):
        aside.append(run.part.rename(run.part.with_name("aside")))
        os.close(run.recorder._file._name)
        run.recorder._file._name = None  # as on a system that does not report it

    run = begun(move)
    run.wait(lambda: "this system does not report the new path" in run.recorder.status().trouble)
    assert run.recorder.status().file is None
    status = run.recorder.finish()
    assert status.file is None and (status.rows, status.lost) == (4000, 0)
    assert "this system does not report its new path" in status.trouble
    assert "to finish it, run: punctura export MOVED_FILE --out FILE.parquet" in status.trouble
    assert open_recording(aside[0]).rows == 4000


@on_posix
def test_a_file_that_comes_back_is_finished_and_the_note_says_so(begun):
    aside = []

    def move(run):
        aside.append(run.part.rename(run.part.with_name("aside")))

    run = begun(move)
    run.wait(lambda: "was moved" in run.recorder.status().trouble)
    run.wait(lambda: run.recorder.status().rows == 4000)
    aside[0].rename(run.part)
    run.go()
    status = run.recorder.finish()
    assert status.finished and (status.rows, status.lost) == (6000, 0)
    assert any("was moved" in note and "resolved after" in note for note in status.notes)


def test_a_recording_does_not_replace_a_file_created_during_the_run(start):
    run = start(ticks=500)
    run.go()
    run.path.write_bytes(b"another")
    status = run.recorder.finish()
    assert run.path.read_bytes() == b"another" and "was created by another program" in status.trouble
    assert open_recording(status.file).rows == status.rows == 500


def test_ticks_from_before_the_recording_are_not_lost(start, tmp_path):
    run = start(ticks=300)
    run.record()
    with Recorder(run.loop, tmp_path / "second.parquet") as recorder:
        run.go()
    assert (recorder.status().rows, recorder.status().lost) == (300, 0)


OUTSIDE = [OSError(errno.EMFILE, "Too many open files"), MemoryError("malloc failed"), MemoryError()]


@pytest.mark.parametrize("error", OUTSIDE, ids=repr)
def test_a_whole_file_that_cannot_be_opened_at_the_end_is_not_called_lost(start, monkeypatch, error):
    run = start(ticks=2000)
    run.go()
    monkeypatch.setattr(finish, "PartFile", Failing(finish.PartFile, error, [1]))
    status = run.recorder.finish()
    assert not status.finished and (status.rows, status.last_tick, status.lost, status.notes) == (2000, 1999, 0, [])
    assert (
        f"the recording is in {status.file}; to finish it, run: punctura export {status.file} --out" in status.trouble
    )
    assert open_recording(status.file).rows == 2000


def test_a_file_that_is_read_only_in_part_at_the_end_is_kept(start, monkeypatch):
    monkeypatch.setattr("punctura.record.recorder._ROWS_AT_ONCE", 500)
    run = start(ticks=2000)
    run.go()
    with monkeypatch.context() as patch:
        sound = Failing(Decoder._sound, MemoryError(), [3])
        patch.setattr(Decoder, "_sound", lambda decoder, batch, metadata: sound(batch, metadata))
        status = run.recorder.finish()
    assert not status.finished and not run.path.exists() and "2000 ticks in the file could be read" in status.trouble
    assert status.rows + status.lost == 2000 and open_recording(status.file).rows == 2000


def test_a_file_that_is_spoiled_is_not_called_readable(start, monkeypatch):
    run = start(ticks=2000)
    run.go()
    monkeypatch.setattr(finish, "PartFile", Failing(finish.PartFile, RecordingError("damaged"), [1]))
    status = run.recorder.finish()
    assert (status.rows, status.lost) == (0, 2000) and status.trouble.endswith(
        "damaged; no tick of the recording can be read"
    )


def test_a_ring_that_is_smaller_than_was_asked_for_is_reported(start):
    run = start(ticks=300, capacity=1 << 40)
    (note,) = run.record().recorder.status().notes
    assert f"{1 << 40} to {run.recorder._listener.capacity} snapshots" in note
    assert list(open_recording(run.path).notes) == [note]
