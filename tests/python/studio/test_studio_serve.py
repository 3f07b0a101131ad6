"""The studio as a program: its output, its exit, and that the force is off afterwards."""

import asyncio
import gc
import os
import signal
import socket
import subprocess
import sys

import pytest
from heed import heed_signals
from punctura.studio.client import StudioClient
from punctura.studio.loaded import from_name
from punctura.studio.run import Settings
from punctura.studio.serve import StudioError, StudioServer, token_from_environment
from punctura.studio.shelf import default_folder
from waiting import PATIENCE_S, wait_until


def start(tmp_path, *more, **environment):
    (tmp_path / "page").mkdir(exist_ok=True)
    (tmp_path / "page" / "index.html").write_text("<!doctype html>")
    command = [sys.executable, "-m", "punctura", "run", "k06-fig10", "--no-browser", "--device", "simulated"]
    command += ["--page", str(tmp_path / "page"), "--recordings", str(tmp_path / "kept"), *more]
    return subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, **environment},
        preexec_fn=heed_signals if os.name == "posix" else None,
    )


def test_it_prints_its_address_and_ends_after_the_time_that_was_asked_for(tmp_path):
    process = start(tmp_path, "--duration", "0.1")
    assert process.stdout.readline().startswith("http://127.0.0.1:")
    out, said = process.communicate(timeout=PATIENCE_S)
    assert (process.returncode, out) == (0, "")
    assert "K06 Fig. 10 on PHANTOM Omni, simulated" in said and "Traceback" not in said


@pytest.mark.skipif(os.name != "posix", reason="sends signals")
@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP", "SIGINT"])
def test_a_signal_ends_it_with_the_recording_whole(tmp_path, name):
    process = start(tmp_path)
    with StudioClient(process.stdout.readline().strip()) as page:
        assert page.ask(do="start_recording", name="r")["ok"]
        page.wait(lambda: page.last and page.last.run == 1)
        process.send_signal(getattr(signal, name))
        page._thread.join(PATIENCE_S)
        assert page.closed is not None
    _, said = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 128 + getattr(signal, name) and "Traceback" not in said
    assert [p.name for p in (tmp_path / "kept").iterdir()] == ["r.parquet"]


def test_a_studio_that_was_started_anew_with_the_same_token_takes_its_page_back(tmp_path):
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    for _ in range(2):
        process = start(tmp_path, "--port", str(port), PUNCTURA_STUDIO_TOKEN="abcdefghijklmnop-_1")
        url = process.stdout.readline().strip()
        assert url == f"http://127.0.0.1:{port}/?token=abcdefghijklmnop-_1", process.stderr.read()
        with StudioClient(url) as page:
            page.wait(lambda: page.last)
        process.terminate()
        process.communicate(timeout=PATIENCE_S)


def test_a_token_that_could_be_guessed_is_refused(monkeypatch):
    for bad in ("short", "with a space in the middle", "x" * 20 + "\n"):
        monkeypatch.setenv("PUNCTURA_STUDIO_TOKEN", bad)
        with pytest.raises(StudioError, match="16"):
            token_from_environment()


def test_a_port_that_is_taken_is_reported(tmp_path):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        process = start(tmp_path, "--port", str(taken.getsockname()[1]))
        _, said = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 1 and "leave out --port" in said and "Traceback" not in said


def test_each_run_has_a_token_of_its_own_and_answers_on_loopback_alone(served, tmp_path):
    assert len(served.address.token) >= 32
    assert served._socket.getsockname()[0] == "127.0.0.1"
    other = StudioServer(from_name("k06-fig10"), Settings(), page=tmp_path, folder=tmp_path)
    assert other.address.token != served.address.token
    other.stop()


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_no_force_is_left_when_it_stops_nor_when_the_worker_fails(served, page):
    page.target([0.0, -3e-3, 0.0], [0.0, -1.0, 0.0])
    page.wait(lambda: abs(float(page.last.ticks["force"][-1][1])) > 0.1)
    device = served.session.run.loop.device

    def fail():
        raise SystemExit("a defect")

    served.session.jobs.post(fail)
    wait_until(lambda: not served.session.running)
    assert not served.running
    assert tuple(device.last_force) == (0.0, 0.0, 0.0)
    assert not page.ask(do="arm")["ok"]


def test_figures_are_served_once_they_are_made_and_nothing_else_of_their_folder(served, page, tmp_path):
    folder = tmp_path / "out"
    served.studio.figures._folders = [folder]
    assert page.get("/figures/")[0] == 404
    folder.mkdir()
    for name in ("index.html", "fig03.png", "private.txt", "mine.csv"):
        (folder / name).write_text(name)
    assert page.get("/figures/") == (200, b"index.html")
    assert page.get("/figures/fig03.png")[0] == 200
    for name in ("private.txt", "mine.csv", "fig05.png", "../x", "%2e%2e/kept"):
        assert page.get(f"/figures/{name}")[0] == 404


def test_recordings_are_kept_where_a_person_s_data_is():
    assert default_folder().parts[-2:] == ("punctura", "recordings")


def test_no_frame_is_held_back_for_an_acknowledgement(page, served):
    """With Nagle's algorithm, a frame after a message would come 40 ms late, and then three at once."""
    transports = [one for one in gc.get_objects() if issubclass(type(one), asyncio.Transport)]
    sockets = [transport.get_extra_info("socket") for transport in transports]
    own = [one for one in sockets if one and one.fileno() >= 0 and one.getsockname()[1] == served.address.port]
    assert own and all(one.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY) for one in own)
