"""A studio with a stopped terminal, or with output that nobody reads."""

import os
import re
import signal
import subprocess
import sys
import threading

import pytest
from heed import heed_signals
from punctura.studio.client import StudioClient
from terminals import BLOCKED, read_until, stop, stopped_terminal, terminal
from waiting import PATIENCE_S

# Its server's thread has a lot to log before it may answer; what it has logged is said on stdout.
FLOODED = """
import sys
from pathlib import Path
from punctura.studio.loaded import from_name
from punctura.studio.run import Settings
from punctura.studio.serve import StudioServer, report_defect

folder = Path(sys.argv[1])
server = StudioServer(from_name("k06-fig10"), Settings(device="simulated"), page=folder, folder=folder / "kept")
server.start()
print(server.address.url, flush=True)
sys.stdin.readline()
server.hub.post(lambda: [report_defect(OSError("x" * 1000)) for _ in range(500)])
server.hub.post(lambda: print("flooded", flush=True))
sys.stdin.readline()
server.stop()
print("stopped", flush=True)
"""


@pytest.mark.parametrize("blocked", BLOCKED)
def test_pause_is_answered_while_nobody_reads_a_flood_of_log_lines(tmp_path, blocked):
    with BLOCKED[blocked]() as stderr:
        command = [sys.executable, "-c", FLOODED, str(tmp_path)]
        process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=stderr, text=True, bufsize=1
        )
        watchdog = threading.Timer(60, process.kill)
        watchdog.start()
        try:
            with StudioClient(process.stdout.readline().strip()) as page:
                page.wait(lambda: page.last)
                process.stdin.write("\n")
                assert process.stdout.readline() == "flooded\n"
                assert page.ask(do="pause")["ok"]
                assert not page.status()["armed"]
            process.stdin.write("\n")
            assert process.stdout.readline() == "stopped\n"
            assert process.wait(PATIENCE_S) == 0
        finally:
            watchdog.cancel()
            process.kill()
            process.communicate()


def studio(tmp_path, slave, *more):
    (tmp_path / "page").mkdir()
    (tmp_path / "page" / "index.html").write_text("<!doctype html>")
    command = [sys.executable, "-m", "punctura", "run", "--no-browser", "--device", "simulated"]
    command += ["--page", str(tmp_path / "page"), "--recordings", str(tmp_path / "kept"), *more]
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    return subprocess.Popen(command, stdin=slave, stdout=slave, stderr=slave, env=environment, preexec_fn=heed_signals)


def test_a_termination_ends_a_studio_on_a_stopped_terminal_with_its_recording_whole(tmp_path):
    with terminal() as (master, slave):
        process = studio(tmp_path, slave)
        try:
            said = read_until(master, b"token=")
            while said.count("\n", said.index("token=")) == 0:
                said += read_until(master, b"\n")
            stop(slave)
            with StudioClient(re.search(r"http://\S+", said)[0]) as page:
                assert page.ask(do="start_recording", name="r")["ok"]
                page.wait(lambda: page.last and page.last.run == 1)
                process.send_signal(signal.SIGTERM)
                assert process.wait(PATIENCE_S) == 128 + signal.SIGTERM
        finally:
            process.kill()
            process.wait()
    assert [p.name for p in (tmp_path / "kept").iterdir()] == ["r.parquet"]


def test_a_studio_ends_after_its_time_on_a_stopped_terminal(tmp_path):
    with stopped_terminal() as slave:
        process = studio(tmp_path, slave, "--duration", "1")
        try:
            assert process.wait(PATIENCE_S) == 0
        finally:
            process.kill()
            process.wait()
