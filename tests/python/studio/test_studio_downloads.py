"""Unread downloads soon release their file and their slot, and a kill leaves no file of them."""

import csv
import io
import os
import socket
import sys
import time
from contextlib import suppress
from pathlib import Path
from urllib.parse import quote

import pyarrow.parquet as pq
import pytest
from punctura import load_scene
from punctura._core import ServoLoop, SimulatedDevice
from punctura.record import Recorder, RecordingError, export, open_recording
from punctura.record.save_as import PIECE_BYTES, export_pieces
from punctura.simulation import Strokes
from punctura.studio import computing, connections
from punctura.studio.limits import MOST_EXPORTS
from punctura.studio.shelf import LEFT_OVER_S, Shelf
from recorded import assert_same_table
from waiting import PATIENCE_S, wait_until

TICKS = 40_000  # 30 MB as CSV: more than what the system keeps of a connection


def make(path, ticks):
    path.parent.mkdir(exist_ok=True)
    device = SimulatedDevice(Strokes((0, 5e-3, 0), (0, -0.02, 0), duration=0.3), real_time=False, ticks=ticks)
    loop = ServoLoop(device, load_scene("k06-fig12"))
    with Recorder(loop, path, ticks) as recorder:
        loop.arm()
        loop.start()
        wait_until(lambda: loop.report()["ticks"] >= ticks)
        loop.stop()
    return recorder.status()


@pytest.mark.parametrize("kind", ["csv", "parquet", "mcap"])
def test_what_is_sent_is_what_an_export_writes(tmp_path, kind):
    make(tmp_path / "run.parquet", 5000)
    pieces = list(export_pieces(open_recording(tmp_path / "run.parquet"), kind))
    assert max(len(piece) for piece in pieces) <= PIECE_BYTES
    sent, out = b"".join(pieces), tmp_path / f"out.{kind}"
    if kind == "parquet":
        table = pq.read_table(io.BytesIO(sent))
        (tmp_path / "sent.parquet").write_bytes(sent)
        assert open_recording(tmp_path / "sent.parquet").rows == 5000
        assert_same_table(table, pq.read_table(tmp_path / "run.parquet"))
        return
    export(tmp_path / "run.parquet", out)
    if kind == "csv":
        assert sent == out.read_bytes() and len(list(csv.reader(io.StringIO(sent.decode())))) == 5001
    else:
        from mcap.reader import make_reader

        ours, theirs = (
            [message.data for _, _, message in make_reader(io.BytesIO(data)).iter_messages(log_time_order=False)]
            for data in (sent, out.read_bytes())
        )
        assert ours == theirs and len(ours) == 5001


class Unread:
    """A download whose response is never read beyond its beginning."""

    def __init__(self, served, path, kind="csv"):
        self.socket = socket.create_connection(("127.0.0.1", served.address.port))
        head = f"GET {quote(path)}?format={kind} HTTP/1.1\r\nHost: 127.0.0.1:{served.address.port}\r\n"
        self.socket.sendall((head + f"Authorization: Bearer {served.address.token}\r\n\r\n").encode())
        self.begin = self.socket.recv(15)


def test_a_download_that_nobody_reads_holds_no_file_and_gives_its_place_back(served, page, monkeypatch):
    monkeypatch.setattr(connections, "UNREAD_S", 0.3)
    folder = served.session.shelf.folder
    make(folder / "Größe.parquet", TICKS)
    address = "/api/recordings/Größe/download"
    unread = [Unread(served, address) for _ in range(MOST_EXPORTS)]
    assert [one.begin for one in unread] == [b"HTTP/1.1 200 OK"] * MOST_EXPORTS
    assert os.listdir(folder) == ["Größe.parquet"]
    page.wait(lambda: page.get(address + "?format=csv")[0] == 200)
    for one in unread:
        one.socket.close()


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux lists the open files of a process")
def test_a_finished_file_that_nobody_reads_is_closed_after_the_same_time(served, page, monkeypatch):
    monkeypatch.setattr(connections, "UNREAD_S", 0.3)
    folder = served.session.shelf.folder
    folder.mkdir()
    file = folder / "run.parquet"
    file.write_bytes(bytes(50_000_000))  # sent as it is, without a look inside; more than the system keeps
    before = set(served.connections.known)
    unread = Unread(served, "/api/recordings/run/download", "parquet")
    assert unread.begin == b"HTTP/1.1 200 OK"
    page.wait(lambda: set(served.connections.known) <= before)
    page.wait(lambda: not opened(file))
    unread.socket.settimeout(PATIENCE_S)
    assert sum(map(len, iter(lambda: unread.socket.recv(1 << 20), b""))) < 50_000_000
    unread.socket.close()


def opened(file):
    """How many times this process has the file open."""
    count = 0
    for number in os.listdir("/proc/self/fd"):
        with suppress(OSError):
            count += os.readlink(f"/proc/self/fd/{number}") == str(file)
    return count


def test_a_download_that_is_broken_off_gives_its_place_back_at_once(served, page):
    folder = served.session.shelf.folder
    make(folder / "run.parquet", TICKS)
    address = "/api/recordings/run/download"
    for _ in range(2 * MOST_EXPORTS):
        Unread(served, address).socket.close()
    page.wait(lambda: page.get(address + "?format=csv")[0] == 200)
    assert os.listdir(folder) == ["run.parquet"]


def test_too_many_downloads_at_once_are_reported(served, page):
    make(served.session.shelf.folder / "run.parquet", TICKS)
    address = "/api/recordings/run/download"
    unread = [Unread(served, address) for _ in range(MOST_EXPORTS)]
    status, text = page.get(address + "?format=csv")
    assert status == 503 and b"try again when one is done" in text
    assert page.get(address)[0] == 200  # the finished file itself takes no place
    for one in unread:
        one.socket.close()


def test_a_file_that_is_damaged_is_told_and_takes_no_place(served, page):
    folder = served.session.shelf.folder
    folder.mkdir()
    (folder / "bad.parquet").write_bytes(b"PAR1 and nothing more")
    for _ in range(2 * MOST_EXPORTS):
        assert page.get("/api/recordings/bad/download?format=csv")[0] == 422


def test_a_download_that_cannot_begin_gives_its_place_back():
    def fails():
        raise RecordingError("damaged")
        yield b""

    place = computing.threading.BoundedSemaphore(1)
    place.acquire()
    with pytest.raises(RecordingError):
        computing.Download(fails(), place)
    assert place.acquire(blocking=False)


def test_what_killed_processes_left_is_removed_when_a_studio_starts(tmp_path):
    old = time.time() - 2 * LEFT_OVER_S
    (tmp_path / ".export-abc").mkdir()
    (tmp_path / ".export-abc" / "out.csv").write_bytes(b"1")
    (tmp_path / ".export-new").mkdir()
    names = (".run.parquet.0123abcd.part", "run.parquet.part", ".mine", "run.parquet", ".x.parquet.part")
    for name in names:
        (tmp_path / name).touch()
    (tmp_path / ".young.parquet.0123abcd.part").touch()
    for name in (".export-abc", *names):
        os.utime(tmp_path / name, (old, old))
    Shelf(tmp_path)
    left = {path.name for path in tmp_path.iterdir()}
    assert left == {".export-new", ".young.parquet.0123abcd.part", *names[1:]}


def test_a_recording_that_is_finished_between_two_looks_is_found(tmp_path, monkeypatch):
    part, finished = tmp_path / "one.parquet.part", tmp_path / "one.parquet"
    part.touch()
    is_file = Path.is_file

    def finish_after(path):
        there = is_file(path)
        if path == finished and part.exists():
            part.rename(finished)
        return there

    monkeypatch.setattr(Path, "is_file", finish_after)
    assert Shelf(tmp_path).find("one") == finished
