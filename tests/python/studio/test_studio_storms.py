"""Attacks by another user of the same computer without a token, and by a program with a token that does not read."""

import base64
import contextlib
import json
import os
import signal
import socket
import subprocess
import sys
import time

import pytest
from heed import heed_signals
from punctura.studio import connections as rules
from punctura.studio import gate
from punctura.studio.client import StudioClient
from punctura.studio.limits import MOST_BUFFERED, REQUESTS_AT_ONCE
from punctura.studio.wire.messages import Notice
from waiting import PATIENCE_S, wait_until

PING, PONG, TEXT = b"\x89\x80\0\0\0\0", b"\x8a\x80\0\0\0\0", b"\x81\x80\0\0\0\0"
FRAGMENT, BEGINNING = b"\x00\x80\0\0\0\0", b"\x01\x80\0\0\0\0"


@pytest.fixture
def guarded(guarded):
    """A studio with no limits used up by the previous test."""
    for bucket in (guarded.guard.bucket, guarded.guard.free, guarded.guard.refusals):
        bucket.fill()
    return guarded


def tcp(server):
    return socket.create_connection(("127.0.0.1", server.address.port), 20)


def reads_little(server):
    """A connection with a small receive buffer."""
    raw = socket.socket()
    raw.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    raw.connect(("127.0.0.1", server.address.port))
    return raw


def buffered(connection):
    """Bytes that asyncio holds for the other end. Python 3.12 and later add up a deque, which the server's thread may
    change meanwhile."""
    while True:
        with contextlib.suppress(RuntimeError):
            return connection.transport.get_write_buffer_size()


def request(server, path, *headers):
    lines = [f"GET {path} HTTP/1.1", f"Host: 127.0.0.1:{server.address.port}", *headers]
    return "\r\n".join(lines).replace("TOKEN", server.address.token).encode() + b"\r\n\r\n"


def upgrade(server, token="TOKEN"):
    key = base64.b64encode(os.urandom(16)).decode()
    return request(
        server,
        "/ws",
        f"Origin: http://127.0.0.1:{server.address.port}",
        "Upgrade: websocket",
        "Connection: Upgrade",
        "Sec-WebSocket-Version: 13",
        f"Sec-WebSocket-Key: {key}",
        f"Sec-WebSocket-Protocol: punctura.v1, token.{token}",
    )


def everything(raw):
    """All data until the other end closes the connection in any way."""
    data, patience = b"", Patience()
    with contextlib.suppress(ConnectionResetError):
        while part := raw.recv(1 << 16):
            data += part
            patience.check()
    return data


class Patience:
    """Ends a test that would wait forever."""

    def __init__(self):
        self._end = time.monotonic() + 60

    def check(self):
        assert time.monotonic() < self._end, "it has not come to that"


def test_a_refused_socket_is_no_socket_and_its_pings_get_no_answer(guarded):
    with tcp(guarded) as raw:
        raw.sendall(upgrade(guarded, token="wrong"))
        answer = b""
        while b".\n" not in answer:
            answer += raw.recv(1 << 16)
        assert answer.startswith(b"HTTP/1.1 401 ") and b"connection: close" in answer.lower()
        with contextlib.suppress(ConnectionError):
            raw.sendall(PING * 1000)
        assert everything(raw) == b""


@pytest.mark.parametrize(
    "frames",
    [PING * REQUESTS_AT_ONCE, PONG * REQUESTS_AT_ONCE, BEGINNING + FRAGMENT * REQUESTS_AT_ONCE],
    ids=["pings", "pongs", "fragments"],
)
def test_frames_of_every_kind_are_counted(guarded, monkeypatch, frames):
    monkeypatch.setattr(gate, "REQUESTS_A_SECOND", 0.0)
    monkeypatch.setattr(gate, "CLOSE_S", 0.1)
    with tcp(guarded) as raw:
        raw.sendall(upgrade(guarded))
        assert b" 101 " in raw.recv(100)  # what is sent before the answer is not looked at
        raw.sendall(frames + PING)
        assert everything(raw).endswith(b"\x03\xf0Too many requests.")


def test_a_ping_gets_no_answer_while_answers_are_not_read(guarded, monkeypatch):
    monkeypatch.setattr(gate, "MOST_PONGS", -1)
    with StudioClient(guarded.address.url) as page:
        answered = page._socket.ping()
        assert page.ask(do="take_control")["ok"]
        assert not answered.is_set()


def test_a_page_that_does_not_read_is_ended_and_the_others_see_every_tick(guarded, monkeypatch):
    monkeypatch.setattr(rules, "UNREAD_S", 0.2)
    with StudioClient(guarded.address.url) as other, reads_little(guarded) as raw:
        raw.sendall(upgrade(guarded))
        wait_until(lambda: len(guarded.hub.viewers) == 2)
        silent = list(guarded.connections.known)[-1]
        assert silent.socket
        silent.transport.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 4096)
        most = 0
        for _ in range(5):
            guarded.hub.send(Notice(text="x" * 200_000))
        patience = Patience()
        while len(guarded.hub.viewers) == 2:
            patience.check()
            most = max(most, buffered(silent))
        assert MOST_BUFFERED < most < MOST_BUFFERED + 250_000  # one message beyond the mark
        other.wait(lambda n=other.ticks: other.ticks > n + 100)
        assert other.gaps == 0


def test_answers_that_nobody_reads_do_not_pile_up_and_end_their_connection(guarded, monkeypatch):
    monkeypatch.setattr(rules, "UNREAD_S", 0.2)
    with reads_little(guarded) as raw:
        raw.sendall(request(guarded, "/api/schema?token=TOKEN"))
        wait_until(lambda: guarded.connections.known)
        (connection,) = guarded.connections.known
        connection.transport.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 4096)
        raw.setblocking(False)
        many = request(guarded, "/api/schema?token=TOKEN") * 200
        most = 0
        monkeypatch.setattr(guarded.guard.bucket, "_rate", 1e9)
        patience = Patience()
        while guarded.connections.known:
            patience.check()
            with contextlib.suppress(BlockingIOError, ConnectionError):
                raw.send(many)
            most = max(most, buffered(connection))
        assert MOST_BUFFERED < most < 2 * MOST_BUFFERED


def test_thirty_silent_connections_take_no_place_from_the_page(guarded, monkeypatch):
    monkeypatch.setattr(guarded.connections, "_most_strangers", 20)
    monkeypatch.setattr(rules, "STRANGER_S", 1e9)
    with contextlib.ExitStack() as stack:
        silent = [stack.enter_context(tcp(guarded)) for _ in range(30)]
        for raw in silent[:10]:
            assert everything(raw).startswith(b"HTTP/1.1 408 ")
        assert len(guarded.connections.strangers) <= 20
        with StudioClient(guarded.address.url) as page:
            page.wait(lambda: page.last)
            assert page.get("/api/schema")[0] == 200


def test_requests_without_the_token_take_nothing_from_those_with_it(guarded, monkeypatch):
    monkeypatch.setattr(guarded.guard.bucket, "_rate", 0.0)
    left = guarded.guard.bucket._left
    for path in ("/", "/api/schema", "/api/schema?token=x", "/assets/a.js", "/ws"):
        for _ in range(3):
            with tcp(guarded) as raw:
                raw.sendall(request(guarded, path, "Connection: close"))
                everything(raw)
    assert guarded.guard.bucket._left == left


def test_strangers_are_told_that_they_are_too_many_while_the_page_comes_in(guarded, monkeypatch):
    for bucket in (guarded.guard.free, guarded.guard.refusals):
        monkeypatch.setattr(bucket, "_rate", 0.0)
        bucket.empty()
    for path in ("/", "/assets/a.js", "/ws"):
        with tcp(guarded) as raw:
            raw.sendall(request(guarded, path))
            answer = everything(raw)
            assert answer.startswith(b"HTTP/1.1 429 ") and b"without the token" in answer
            assert b"connection: close" in answer.lower()
    with StudioClient(guarded.address.url) as page:
        page.wait(lambda: page.last)
        for path in (f"/?token={page.token}", f"/assets/token={page.token}/a.js", "/api/schema"):
            assert page.get(path)[0] == 200


def test_the_page_asks_for_its_files_with_the_token(guarded):
    index = guarded.studio.page / "index.html"
    before = index.read_text()
    index.write_text('<link href="./icon.svg"><script src="./assets/a.js"></script>')
    try:
        with StudioClient(guarded.address.url) as page:
            text = page.get(f"/?token={page.token}")[1].decode()
            assert text == f'<link href="./icon.svg"><script src="./assets/token={page.token}/a.js"></script>'
    finally:
        index.write_text(before)


def test_more_connections_with_the_token_than_there_are_places_are_told_so(guarded, monkeypatch):
    with StudioClient(guarded.address.url) as page:
        monkeypatch.setattr(guarded.connections, "_most_known", len(guarded.connections.known))
        status, body = page.get("/api/schema")
        assert status == 503 and b"close some pages" in body
        assert page.ask(do="take_control")["ok"]


@pytest.mark.statistics
@pytest.mark.skipif(os.name != "posix", reason="limits open files")
def test_a_recording_begins_and_ends_among_more_connections_than_open_files(tmp_path):
    (tmp_path / "page").mkdir()
    (tmp_path / "page" / "index.html").write_text("<!doctype html>")
    command = [sys.executable, "-m", "punctura", "run", "k06-fig10", "--no-browser", "--device", "simulated"]
    command += ["--page", str(tmp_path / "page"), "--recordings", str(tmp_path / "kept")]
    studio = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, preexec_fn=heed_signals_with_few_files
    )
    try:
        with StudioClient(studio.stdout.readline().strip()) as page, contextlib.ExitStack() as stack:
            page.wait(lambda: page.last)
            host, port = page.host.split(":")
            for _ in range(300):
                stack.enter_context(socket.create_connection((host, int(port)), 20))
            for name in ("first", "second"):
                assert page.ask(do="start_recording", name=name)["ok"]
                assert page.ask(do="stop_recording")["ok"]
            assert [entry["finished"] for entry in json.loads(page.get("/api/recordings")[1])] == [True, True]
    finally:
        studio.send_signal(signal.SIGINT)
        _, said = studio.communicate(timeout=PATIENCE_S)
    assert "Traceback" not in said


def heed_signals_with_few_files():
    import resource

    heed_signals()
    resource.setrlimit(resource.RLIMIT_NOFILE, (256, 256))
