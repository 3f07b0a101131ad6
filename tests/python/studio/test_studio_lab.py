"""The laboratory's addresses: comparisons, variations, and everything in one zip file."""

import concurrent.futures
import http.client
import io
import json
import math
import os
import re
import socket
import sys
import time
import urllib.error
import urllib.parse
import urllib.request
import zipfile
from pathlib import Path

import pytest
from punctura.compare import background
from punctura.studio import computing, lab
from waiting import PATIENCE_S, wait_until


def get(served, address, /, **asked):
    url = urllib.parse.urlsplit(served.address.url)
    token = urllib.parse.parse_qs(url.query)["token"][0]
    query = urllib.parse.urlencode(asked, doseq=True)
    request = urllib.request.Request(f"{url.scheme}://{url.netloc}{address}?{query}")
    request.add_header("Authorization", f"Bearer {token}")
    try:
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
            return answer.status, answer.read()
    except urllib.error.HTTPError as refusal:
        return refusal.code, refusal.read()


VARIATION = {"path": "membrane[0].stiffness", "from": 300, "to": 900, "count": 3, "speed": 0.02}


def test_a_parameter_of_the_present_scene_is_varied_while_the_run_goes_on(served):
    status, fields = get(served, "/api/lab/fields")
    assert status == 200 and "membrane[0].stiffness" in {one["path"] for one in json.loads(fields)}
    assert set(json.loads(fields)[0]) == {"path", "value", "unit"}
    status, body = get(served, "/api/lab/compare", **VARIATION)
    *shares, last = [json.loads(line) for line in body.splitlines() if line]
    assert status == 200 and len(shares) == 3
    peaks = [one["peak"] for one in last["comparison"]["statistics"]]
    assert peaks == sorted(peaks) and peaks[0] < peaks[-1]


def scenes_of(body):
    with zipfile.ZipFile(io.BytesIO(body)) as file:
        return [file.read(name) for name in sorted(file.namelist()) if name.startswith("scenes/")]


def test_the_zip_file_has_the_scene_that_was_varied_whatever_the_run_does_meanwhile(served, page):
    status, body = get(served, "/api/lab/bundle", id="one", **VARIATION)
    assert status == 422 and "simulate it again" in body.decode()
    get(served, "/api/lab/compare", id="one", **VARIATION)
    body = get(served, "/api/lab/bundle", id="one", **VARIATION)[1]
    names = zipfile.ZipFile(io.BytesIO(body)).namelist()
    assert {"figure.svg", "figure.pdf", "README.txt", "CITATION.cff"} <= set(names)
    before = scenes_of(body)
    assert len(before) == VARIATION["count"]
    run = page.run
    assert page.ask(do="load", scene="venipuncture")["ok"]
    page.wait(lambda: page.run > run)
    assert scenes_of(get(served, "/api/lab/bundle", id="one", on="time", **VARIATION)[1]) == before
    assert scenes_of(get(served, "/api/lab/bundle", **VARIATION)[1]) != before


@pytest.mark.parametrize(
    "asked, words",
    [
        ({}, "choose 1 to 25"),
        ({"run": "../secret"}, "a name"),
        ({"run": "nothing"}, "nothing"),
        ({**VARIATION, "count": 1000}, "1 to 25 runs"),
        ({**VARIATION, "from": "many"}, "must be a number"),
        ({**VARIATION, "on": "mass"}, "depth or time"),
    ],
)
def test_a_job_that_is_not_possible_is_refused_with_the_reason(served, asked, words):
    status, body = get(served, "/api/lab/compare", **asked)
    assert 400 <= status < 500 and words in body.decode().lower()


@pytest.mark.parametrize(
    "program, words",
    [
        ("raise TypeError('a wrong number')", "status 1); a defect, please report it: .*TypeError: a wrong number"),
        ("raise MemoryError", "is there enough memory"),
        ("import os; os.kill(os.getpid(), 9)", "is there enough memory"),
        ("import os; os.kill(os.getpid(), 15)", "status -15.*no message"),
    ],
)
def test_a_worker_that_ends_early_tells_why(served, monkeypatch, program, words):
    monkeypatch.setattr(lab, "COMMAND", [sys.executable, "-c", program])
    status, body = get(served, "/api/lab/compare", **VARIATION)
    assert status == 200 and re.search(words.replace("1)", r"1\)"), json.loads(body)["error"])


WITH_A_CHILD = """
import os, subprocess, sys, time
child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
open({mark!r} + ".new", "w").write(f"{{os.getpid()}} {{child.pid}}")
os.rename({mark!r} + ".new", {mark!r})
time.sleep(600)
"""


@pytest.fixture
def hangs(monkeypatch, tmp_path):
    """A computation that never ends, with a child. The file gets their numbers."""
    mark = tmp_path / "processes"
    monkeypatch.setattr(lab, "COMMAND", [sys.executable, "-c", WITH_A_CHILD.format(mark=str(mark))])
    return mark


def ended(mark):
    """Whether the worker and its child have ended; one that nobody waits for counts as ended."""
    return all(_state(number) in ("", "Z") for number in mark.read_text().split())


def _state(number):
    """The letter of a process's state; empty if it has ended, also while it is read."""
    try:
        return Path(f"/proc/{number}/stat").read_text().rsplit(")")[1].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return ""


@pytest.mark.parametrize("address", ["compare", "bundle"])
def test_a_computation_that_hangs_is_ended_with_its_children_and_told(served, monkeypatch, hangs, address):
    monkeypatch.setattr(computing, "clock", lambda: computing.LONGEST_S + 1 if hangs.exists() else 0.0)
    _, body = get(served, f"/api/lab/{address}", **VARIATION)
    assert "was ended because it took more than 30 minutes; try fewer runs" in body.decode()
    wait_until(lambda: ended(hangs))


def test_a_computation_without_a_processor_says_so_and_one_that_computes_does_not(monkeypatch):
    monkeypatch.setattr(computing, "STARVED_S", 0.5)
    busy = "import time; end = time.process_time() + 1\nwhile time.process_time() < end: pass"
    seen = []
    for program, used in (("import time; time.sleep(1.2)", 0.0), (busy, None)):
        monkeypatch.setattr(computing, "processor_s", lambda _, used=used: math.inf if used is None else used)
        seen.append(set(computing.lines_of([sys.executable, "-c", program], b"", str.encode, "", starved=b"starved")))
    assert seen == [{b"\n", b"starved"}, {b"\n"}]
    assert 0 < background.processor_s(os.getpid()) <= time.process_time() + 1


@pytest.mark.parametrize("program", ["print('result')", "print('result'); raise SystemExit(1)"])
def test_the_group_of_a_worker_is_ended_before_its_number_is_free(monkeypatch, program):
    killed, kill = [], os.killpg
    # Popen knows the exit status only after it has waited for the process, which frees its number.
    waited = lambda number: not Path(f"/proc/{number}").exists()  # noqa: E731
    monkeypatch.setattr(os, "killpg", lambda number, how: (killed.append(waited(number)), kill(number, how)))
    lines = computing.lines_of([sys.executable, "-c", program], b"", str.encode, "")
    result, *failed = [line for line in lines if line.strip()]
    assert result == b"result\n" and len(failed) == ("Exit" in program)
    assert killed and not any(killed)


def test_a_result_that_comes_as_the_time_ends_is_kept(monkeypatch):
    monkeypatch.setattr(computing, "_next", lambda lines: lines.get(timeout=PATIENCE_S))
    times = iter([0.0])
    monkeypatch.setattr(computing, "clock", lambda: next(times, computing.LONGEST_S + 1))
    command = [sys.executable, "-c", "print('result')"]
    assert list(computing.lines_of(command, b"", str.encode, "")) == [b"result\n"]


@pytest.mark.parametrize("address", ["compare", "bundle"])
def test_leaving_a_computation_that_hangs_ends_it_and_frees_the_place(served, monkeypatch, hangs, address):
    url = urllib.parse.urlsplit(served.address.url)
    connection = http.client.HTTPConnection(url.netloc, timeout=PATIENCE_S)
    token = urllib.parse.parse_qs(url.query)["token"][0]
    asked = urllib.parse.urlencode(VARIATION)
    connection.request("GET", f"/api/lab/{address}?{asked}", headers={"Authorization": f"Bearer {token}"})
    wait_until(hangs.exists)
    connection.sock.shutdown(socket.SHUT_RDWR)
    connection.close()
    wait_until(lambda: ended(hangs))
    monkeypatch.undo()
    wait_until(lambda: get(served, "/api/lab/compare", **VARIATION)[0] == 200)


def test_a_killed_worker_is_told_though_its_child_lives_on(served, hangs):
    with concurrent.futures.ThreadPoolExecutor() as pool:
        asked = pool.submit(get, served, "/api/lab/compare", **VARIATION)
        wait_until(hangs.exists)
        os.kill(int(hangs.read_text().split()[0]), 9)
        _, body = asked.result(60)
    assert "is there enough memory" in body.decode()
    wait_until(lambda: ended(hangs))


def test_fields_on_which_no_curve_depends_are_not_offered(served, page):
    assert page.ask(do="load", scene="epidural")["ok"]
    fields = {one["path"] for one in json.loads(get(served, "/api/lab/fields")[1])}
    assert "membrane[0].stiffness" in fields
    assert not [path for path in fields if "syringe" in path or "outflow" in path or "behind" in path]
