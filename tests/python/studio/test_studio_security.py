"""Any client except this run's page is rejected with a status and a message, without an effect on the loop."""

import contextlib
import gzip
import http.client
import json
import logging
import os
import socket

import pytest
from punctura.studio import gate
from punctura.studio import hub as hubs
from punctura.studio.client import StudioClient
from punctura.studio.limits import MOST_BODY, REQUESTS_AT_ONCE
from waiting import PATIENCE_S, wait_until
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect


def get(server, path="/", method="GET", host=None, body=None, **headers):
    """Sends a request unchanged. Returns status, headers, body."""
    port, token = server.address.port, server.address.token
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE_S)
    connection.putrequest(method, path.replace("TOKEN", token), skip_host=True)
    for name, value in {"Host": host or f"127.0.0.1:{port}", **headers}.items():
        if value:
            connection.putheader(name, value.replace("TOKEN", token).replace("PORT", str(port)))
    connection.endheaders(body)
    answer = connection.getresponse()
    return answer.status, answer.headers, answer.read()


@pytest.fixture(autouse=True)
def the_loop_goes_on_unfaulted(guarded):
    before = guarded.session.run.loop.report()["ticks"]
    yield
    wait_until(lambda: guarded.session.run.loop.report()["ticks"] > before)
    assert guarded.session.running and not guarded.session.run.loop.fault_history()["tick"].size
    assert guarded.session.pump.lost == 0 and guarded.session.run.lost == 0


def test_the_page_and_its_own_requests_come_in(guarded):
    port = guarded.address.port
    for host in (f"127.0.0.1:{port}", f"localhost:{port}", f"[::1]:{port}", f"LOCALHOST:{port}"):
        assert get(guarded, "/?token=TOKEN", host=host)[0] == 200
    assert get(guarded, "/api/schema", Authorization="Bearer TOKEN")[0] == 200
    assert get(guarded, "/api/schema", Authorization="Bearer TOKEN", Origin="http://127.0.0.1:PORT")[0] == 200
    assert get(guarded, "/assets/a.js")[0] == 200


def test_the_files_of_the_page_come_compressed_to_whom_takes_it(guarded):
    for path in ("/assets/a.js", "/assets/token=TOKEN/a.js", "/assets/token=another/a.js"):
        status, headers, body = get(guarded, path, **{"Accept-Encoding": "br, gzip;q=0.9"})
        assert (status, headers["content-encoding"], gzip.decompress(body)) == (200, "gzip", b"1")
        assert headers["content-type"].startswith("text/javascript") and headers["vary"] == "accept-encoding"
        status, headers, body = get(guarded, path)
        assert (status, headers["content-encoding"], body) == (200, None, b"1")
    for path in ("/assets/token=TOKEN/b.js", "/assets/token=TOKEN/../../page_files.py", "/assets/token=TOKEN/"):
        assert get(guarded, path, **{"Accept-Encoding": "gzip"})[0] == 404


def test_a_file_whose_path_has_the_token_is_no_file_for_strangers(guarded, monkeypatch):
    monkeypatch.setattr(guarded.guard.free, "_rate", 0.0)
    guarded.guard.free.empty()
    assert get(guarded, "/assets/token=TOKEN/a.js")[0] == 200
    for path in ("/assets/a.js", "/assets/token=another/a.js"):
        assert get(guarded, path)[0] == 429


def test_every_answer_forbids_what_a_page_does_not_need(guarded):
    for path in ("/?token=TOKEN", "/", "/assets/a.js", "/api/schema?token=TOKEN", "/nothing?token=TOKEN"):
        headers = get(guarded, path)[1]
        assert headers["cache-control"] == "no-store" and headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "no-referrer"
        policy = headers["content-security-policy"]
        assert "default-src 'none'" in policy and "unsafe" not in policy and "frame-ancestors 'none'" in policy
        assert "access-control-allow-origin" not in headers and "server" not in headers


@pytest.mark.parametrize(
    "host", ["example.org", "127.0.0.1", "127.0.0.1:1", "localhost.:80", "127.0.0.1:PORT@x", "0.0.0.0"]
)
def test_a_foreign_host_is_refused(guarded, host):
    status, _, body = get(guarded, "/?token=TOKEN", host=host.replace("PORT", str(guarded.address.port)))
    assert status == 421 and b"name" in body


def test_two_hosts_or_none_are_refused(guarded):
    for head in (b"Host: 127.0.0.1:%d\r\nHost: example.org\r\n", b""):
        with socket.create_connection(("127.0.0.1", guarded.address.port), 10) as raw:
            raw.sendall(b"GET / HTTP/1.1\r\n" + head.replace(b"%d", str(guarded.address.port).encode()) + b"\r\n")
            assert raw.recv(1000).split(b" ")[1] in (b"400", b"421")


@pytest.mark.parametrize(
    "origin", ["http://example.org", "https://127.0.0.1:PORT", "http://127.0.0.1:1", "null", "http://localhost:PORT"]
)
def test_a_foreign_origin_is_refused_with_or_without_a_token(guarded, origin):
    for path in ("/?token=TOKEN", "/assets/a.js", "/api/schema?token=TOKEN"):
        assert get(guarded, path, Origin=origin)[0] == 403


@pytest.mark.parametrize(
    "token", ["", "x", "Bearer", "Bearer ", "Bearer x", "Basic TOKEN", "Bearer TOKENx", "Bearer \xff"]
)
def test_without_the_token_the_page_is_empty_and_there_is_no_api(guarded, token):
    status, _, body = get(guarded, "/", Authorization=token)
    assert status == 200 and b"token" not in body
    for path in ("/index.html", "/api/schema", "/api/recordings", "/api/scene.toml", "/api/results", "/ws"):
        status, _, body = get(guarded, path, Authorization=token)
        assert (status, path) == (401, path) and b"token" in body
    assert get(guarded, "/api/schema?token=x")[0] == 401
    assert get(guarded, "/api/schema?" + "&".join(f"a{i}=1" for i in range(50)) + "&token=TOKEN")[0] == 401
    assert get(guarded, "/api/recordings/x", "DELETE", Authorization=token)[0] == 401


def test_other_methods_are_refused(guarded):
    for method in ("POST", "PUT", "PATCH", "OPTIONS", "TRACE"):
        assert get(guarded, "/api/schema?token=TOKEN", method)[0] == 405


def test_a_body_that_is_too_large_is_refused(guarded):
    assert get(guarded, "/api/schema?token=TOKEN", **{"Content-Length": str(MOST_BODY + 1)})[0] == 413
    assert get(guarded, "/api/schema?token=TOKEN", **{"Content-Length": "9" * 30})[0] in (400, 413)


@pytest.mark.parametrize(
    "request_line", ["GET /assets/a.js", "GET /api/schema?token=TOKEN", "DELETE /nothing?token=TOKEN"]
)
@pytest.mark.parametrize("length", ["Transfer-Encoding: chunked", "Content-Length: 60000"])
def test_a_body_without_an_end_is_not_read_after_the_answer(guarded, request_line, length):
    address = ("127.0.0.1", guarded.address.port)
    head = f"{request_line} HTTP/1.1\r\nHost: 127.0.0.1:{address[1]}\r\n{length}\r\n\r\n"
    with socket.create_connection(address, 20) as connection:
        connection.sendall(head.replace("TOKEN", guarded.address.token).encode())
        answer = http.client.HTTPResponse(connection)
        answer.begin()
        assert answer.getheader("connection") == "close"
        answer.read()
        with contextlib.suppress(ConnectionResetError):
            assert connection.recv(1) == b""
    assert get(guarded, "/assets/a.js")[1]["connection"] is None


TRICKS = [
    "../x",
    "..%2fx",
    "%2e%2e/x",
    "..%5cx",
    "....//x",
    "%00",
    "a%00b",
    ".part",
    "x%2f..%2f..%2fx",
    "%ff",
    "nul",
    "a" * 300,
]


@pytest.mark.parametrize("trick", TRICKS)
def test_no_path_leads_out_of_a_folder(guarded, trick):
    kept = guarded.session.shelf.folder
    kept.mkdir(exist_ok=True)
    (kept.parent / "x.parquet").write_bytes(b"PAR1secret")
    (kept.parent / "x").write_bytes(b"secret")
    for path in (
        f"/api/recordings/{trick}", f"/api/recordings/{trick}/ticks", f"/api/recordings/{trick}/download",
        f"/api/results/{trick}", f"/assets/{trick}", f"/{trick}", f"/assets/../../{trick}",
    ):  # fmt: skip
        status, _, body = get(guarded, path + "?token=TOKEN")
        assert status in (400, 404) and b"secret" not in body, path
    assert get(guarded, f"/api/recordings/{trick}?token=TOKEN", "DELETE")[0] in (400, 404, 405)
    assert (kept.parent / "x.parquet").exists()


@pytest.mark.skipif(os.name != "posix", reason="makes links")
def test_links_are_not_followed(guarded, tmp_path):
    kept = guarded.session.shelf.folder
    kept.mkdir(exist_ok=True)
    secret = tmp_path / "secret.parquet"
    secret.write_bytes(b"PAR1secret")
    link = kept / "link.parquet"
    link.symlink_to(secret)
    try:
        assert get(guarded, "/api/recordings?token=TOKEN")[2] == b"[]"
        assert get(guarded, "/api/recordings/link/download?token=TOKEN")[0] == 404
        assert get(guarded, "/api/recordings/link?token=TOKEN", "DELETE")[0] == 404
        with StudioClient(guarded.address.url) as page:
            assert not page.ask(do="start_recording", name="link")["ok"]
    finally:
        link.unlink()
    assert secret.read_bytes() == b"PAR1secret"


def test_what_is_no_recording_is_not_listed_and_says_why(guarded):
    kept = guarded.session.shelf.folder
    kept.mkdir(exist_ok=True)
    (kept / "bad.parquet").write_bytes(b"PAR1 no")
    try:
        assert get(guarded, "/api/recordings?token=TOKEN")[2] == b"[]"
        for tail in ("", "/ticks"):
            assert get(guarded, f"/api/recordings/bad{tail}?token=TOKEN")[0] == 422
    finally:
        (kept / "bad.parquet").unlink()


def socket_to(server, origin="http://127.0.0.1:PORT", token="TOKEN", protocol="punctura.v1", host=None):
    port = str(server.address.port)
    return connect(
        f"ws://127.0.0.1:{port}/ws",
        origin=origin and origin.replace("PORT", port),
        subprotocols=[p for p in (protocol, "token." + token.replace("TOKEN", server.address.token)) if p],
        additional_headers={"Host": host} if host else None,
        proxy=None,
        compression=None,
    )


@pytest.mark.parametrize("origin", [None, "http://example.org", "null", "https://127.0.0.1:PORT"])
def test_a_socket_needs_the_page_s_own_origin(guarded, origin):
    with pytest.raises(InvalidStatus) as refused, socket_to(guarded, origin=origin):
        pass
    assert refused.value.response.status_code == 403
    assert refused.value.response.body.endswith(b".\n")


def test_a_socket_without_the_token_is_refused_in_the_handshake(guarded):
    for token in ("", "x", "TOKENx"):
        with pytest.raises(InvalidStatus) as refused, socket_to(guarded, token=token):
            pass
        assert refused.value.response.status_code == 401 and b"token" in refused.value.response.body
    with pytest.raises(InvalidStatus), socket_to(guarded, protocol=None):
        pass


def closed_after(server, *messages):
    with socket_to(server) as opened:
        with contextlib.suppress(Exception):
            for message in messages:
                opened.send(message)
            for _ in opened:
                pass
        return opened.close_code, opened.close_reason


MALFORMED = {
    "bytes": b"\x00\x01",
    "a frame": b"PNT2" + bytes(36),
    "no JSON": "{",
    "a number": "7",
    "a list": "[]",
    "nothing": "",
    "no id": '{"do": "arm"}',
    "a negative id": '{"id": -1, "do": "arm"}',
    "nested": '{"id": ' + "[" * 5000 + "]" * 5000 + "}",
    "a target at NaN": '{"do": "target", "run": 0, "position": [NaN, 0, 0], "axis": [0, -1, 0]}',
    "a target at infinity": '{"do": "target", "run": 0, "position": [1e999, 0, 0], "axis": [0, -1, 0]}',
    "a surrogate": '{"id": "\\ud800"}',
}


@pytest.mark.parametrize("what", MALFORMED)
def test_what_is_no_request_ends_the_connection_with_a_sentence(guarded, what):
    code, reason = closed_after(guarded, MALFORMED[what])
    assert code == 1008 and reason.endswith(".")


def test_what_only_looks_like_a_request_is_answered(guarded):
    with StudioClient(guarded.address.url) as page:
        for bad in (
            {"do": "fly"},
            {"do": "arm", "more": 1},
            {"do": "compare", "on": 1},
            {"do": "strokes", "period": 0},
        ):
            answer = page.ask(**bad)
            assert not answer["ok"] and answer["problems"]


def test_messages_that_are_too_large_end_the_connection(guarded):
    code, _ = closed_after(guarded, json.dumps({"id": 1, "do": "edit", "tables": {"name": "x" * 70_000}}))
    assert code == 1008
    code, _ = closed_after(guarded, json.dumps({"id": 1, "do": "load_text", "toml": "#" * 300_000}))
    assert code in (1009, 1006)  # the rest of the message may still be on its way when the connection ends
    wait_until(lambda: not guarded.hub.viewers)  # a viewer that has not left yet has control
    with StudioClient(guarded.address.url) as page:
        text = page.get("/api/scene.toml")[1].decode()
        assert page.ask(do="load_text", toml=text + "#" * 150_000)["ok"]


def test_a_page_that_floods_is_closed_and_the_others_stay(guarded, monkeypatch):
    monkeypatch.setattr(gate, "REQUESTS_A_SECOND", 0)  # so that a slow computer floods, too
    with StudioClient(guarded.address.url) as other:
        request = json.dumps({"do": "target", "run": 0, "position": [0, 0.005, 0], "axis": [0, -1, 0]})
        code, reason = closed_after(guarded, *[request] * (2 * REQUESTS_AT_ONCE))
        assert code == 1008 and reason == "Too many requests."
        other.wait(lambda n=other.ticks: other.ticks > n + 100)
        assert other.gaps == 0


def test_too_many_pages_are_refused(guarded, monkeypatch):
    monkeypatch.setattr(hubs, "MOST_VIEWERS", 1)
    with socket_to(guarded):
        wait_until(lambda: guarded.hub.viewers)
        assert closed_after(guarded)[0] == 1013


def test_too_many_requests_are_refused_for_a_moment(guarded, monkeypatch):
    with monkeypatch.context() as still:
        still.setattr(guarded.guard.bucket, "_rate", 0.0)
        guarded.guard.bucket.empty()
        assert get(guarded, "/api/schema?token=TOKEN")[0] == 429
    guarded.guard.bucket.fill()
    assert get(guarded, "/api/schema?token=TOKEN")[0] == 200


def test_a_page_can_ask_why_its_socket_was_refused(guarded):
    assert get(guarded, "/api/access", Authorization="Bearer TOKEN")[0] == 204
    assert get(guarded, "/api/access", Authorization="Bearer x")[0] == 401
    assert get(guarded, "/api/access", Authorization="Bearer TOKEN", Origin="http://example.org")[0] == 403


def test_bytes_that_are_no_http_do_no_harm_and_are_not_logged(guarded, monkeypatch):
    logged, log = [], logging.StreamHandler()
    log.emit = lambda record: logged.append(record.getMessage())
    for name in ("uvicorn.error", "asyncio"):
        monkeypatch.setattr(logging.getLogger(name), "handlers", [log])
    monkeypatch.setattr(guarded.guard, "_report", logged.append)
    host = f"Host: 127.0.0.1:{guarded.address.port}".encode()
    body = b"POST / HTTP/1.1\r\n" + host + b"\r\nTransfer-Encoding: chunked\r\n\r\nno length\r\n"
    for data in (b"\x16\x03\x01" + os.urandom(200), b"GET / HTTP/9.9\r\n\r\n", b"\r\n" * 5000, b"G" * 100_000, body):
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", guarded.address.port), 10) as raw:
            raw.settimeout(2)
            raw.sendall(data)
            raw.shutdown(socket.SHUT_WR)
            while raw.recv(1000):
                pass
    assert get(guarded, "/assets/a.js")[0] == 200
    assert logged == []  # nobody without the token fills the terminal
