"""A separate package adds a device: it is listed, runs by its name, and a failure in it hides no other device."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from punctura.live import enumerate_devices
from waiting import PATIENCE_S

DOCS = (Path(__file__).parents[3] / "docs" / "devices.md").read_text(encoding="utf-8")
HARDWARE = """
import math, time

def read():
    return (0.0, 5e-3 * math.cos(6 * time.monotonic()), 0.0)

def write(force):
    pass

"""


def package(folder, module, text, name="mine"):
    """Makes the package's files as pip installs them."""
    (folder / f"{module}.py").write_text(text)
    about = folder / f"{module}-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {module}\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text(f"[punctura.devices]\n{name} = {module}\n")


def punctura(folder, *arguments):
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    command = [sys.executable, "-m", "punctura", *arguments]
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=PATIENCE_S)


def summary_of_mine(folder, seconds):
    """Of a run with the device `mine`, which ends with status 0."""
    patient = folder / "limits.toml"
    patient.write_text("deadline_ms = 20000\nstale_ms = 20000\n")  # however busy the computer is
    run = ("run", "k06-fig10", "--headless", "--device", "mine", "--duration", seconds, "--json")
    done = punctura(folder, *run, "--limits", str(patient))
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture
def of_the_docs(tmp_path):
    """The package in docs/devices.md, with simulated swinging hardware."""
    text = re.search(r"the whole of `punctura_mine.py`, [^:]*:\n\n```python\n(.*?)```", DOCS, re.S)[1]
    package(tmp_path, "punctura_mine", HARDWARE + text)
    return tmp_path


def test_the_package_of_the_docs_is_listed_and_runs(of_the_docs):
    listed = json.loads(punctura(of_the_docs, "devices", "--json").stdout)
    assert listed[0] == {"backend": "mine", "state": "available", "detail": "", "devices": ["mine 1"]}
    assert {"simulated", "replay", "haply"} < {entry["backend"] for entry in listed}
    summary = summary_of_mine(of_the_docs, seconds="2")
    assert "mine" in summary["device"] and summary["ticks"] > 50 and summary["felt_peak_N"] > 0.1


AT_THE_END = """
import threading
from punctura.live import FedDevice, Pacer
device = FedDevice(1600.0)
def drive(rate):
    pacer = Pacer(rate)
    while True:
        device.feed((0.0, 0.0, 0.0))
        pacer.wait()
for rate in (1600, 5000, 20000, 50000):
    threading.Thread(target=drive, args=(rate,), daemon=True).start()
"""


def test_a_program_ends_whole_while_daemon_threads_feed(tmp_path):
    for _ in range(8):
        done = subprocess.run([sys.executable, "-c", AT_THE_END], capture_output=True, text=True, timeout=PATIENCE_S)
        assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("raise ImportError('no driver here')", "ImportError: no driver here"),
        ("def status(): return {}\ndef open(rate, device): return 3", "returned int, not a Device"),
        ("import asyncio\ndef open(rate, device): raise asyncio.CancelledError('no loop')", "CancelledError: no loop"),
    ],
)
def test_a_package_that_fails_is_told_and_hides_no_other_device(tmp_path, text, words):
    package(tmp_path, "broken", text, name="broken")
    listed = json.loads(punctura(tmp_path, "devices", "--json").stdout)
    assert listed[0]["backend"] == "broken" and listed[0]["state"] == "fault" and "simulated" in listed[-1]["backend"]
    done = punctura(tmp_path, "run", "--headless", "--device", "broken", "--duration", "1")
    assert done.returncode == 2 and words in done.stderr and "Traceback" not in done.stderr


OPEN = "def open(rate, device): raise OSError\n"


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("return {}", "status() must return a dict whose state is one of available, library_not_found, "),
        ("return {}", "; it is {'state': None, ...}"),
        ("return {'state': 'ready'}", "needs_calibration, fault; it is {'state': 'ready', ...}"),
        ("return 3", "it is 3"),
        ("return {'state': 'available', 'detail': None}", "detail of status() must be a text"),
        ("del globals()['open']; return {'state': 'available'}", "mine: it has no function open(rate, device)"),
        ("return {'state': 'available', 'devices': 'mine'}", "devices of status() must be a list of names; it is 'm"),
        ("import asyncio; raise asyncio.CancelledError", "mine: CancelledError"),
        ("raise SystemExit(1)", "mine: SystemExit: 1"),
        ("print('loud'); return {'state': 'ready'}", "it is {'state': 'ready', ...}"),
        ("import os; os.write(1, b'loud'); os._exit(3)", "mine: status() ended its process, with status 3"),
        ("import os; os.kill(os.getpid(), 9)", "mine: status() ended its process, with status -9"),
        ("return {'state': {'a': {1, 2}}}", "mine: TypeError: Object of type set is not JSON serializable"),
        ("a = {}; a['devices'] = [a]; a['state'] = 'no'; return a", "it is {'state': 'no', ...}"),
    ],
)
def test_a_wrong_answer_of_status_is_told(tmp_path, monkeypatch, capfd, body, words):
    package(tmp_path, "mine", f"{OPEN}def status():\n    {body}\n")
    monkeypatch.syspath_prepend(tmp_path)
    listed = enumerate_devices()
    assert listed[0]["state"] == "fault" and words in listed[0]["detail"], listed[0]
    printed, errors = capfd.readouterr()
    assert listed[-1]["backend"] == "simulated" and not printed and ("loud" in errors) == ("loud" in body)


def test_a_status_that_hangs_is_told(tmp_path, monkeypatch):
    package(tmp_path, "a_hanging_device", "import threading\ndef status(): threading.Event().wait()\n", name="hangs")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr("punctura.live.status_probe.STATUS_S", 0.05)
    (entry,) = (entry for entry in enumerate_devices() if entry["backend"] == "hangs")
    assert entry["state"] == "fault" and "no answer from status() within 0.05 s" in entry["detail"]


def test_a_name_with_a_colon_is_told(tmp_path):
    package(tmp_path, "mine", "def status(): return {'state': 'available'}", name="mine:1")
    listed = json.loads(punctura(tmp_path, "devices", "--json").stdout)
    assert listed[0]["state"] == "fault" and "a name with a colon cannot be chosen" in listed[0]["detail"]


def test_unprintable_and_endless_words_of_a_package_hide_no_other_device(tmp_path):
    text = (
        r"open = print"
        "\n"
        r"def status(): return {'state': 'available', 'detail': '\ud800\x1b[2J' + 9999 * 'x', 'devices': ['a\nb']}"
    )
    package(tmp_path, "loud", text, name="loud")
    done = punctura(tmp_path, "devices")
    assert done.returncode == 0 and "simulated" in done.stdout, done.stderr
    assert "??[2J" in done.stdout and "a b" in done.stdout and len(done.stdout) < 9000
    assert "\x1b" not in done.stdout


def test_a_name_of_punctura_s_own_is_not_taken_over(tmp_path):
    package(tmp_path, "other", "def status(): return {'state': 'available'}", name="simulated")
    listed = json.loads(punctura(tmp_path, "devices", "--json").stdout)
    assert "has a device of this name" in listed[0]["detail"]
    assert punctura(tmp_path, "run", "--headless", "--device", "simulated", "--duration", "0.2").returncode == 0


NO_TEXT = """
class NoText(Exception):
    def __str__(self):
        raise RuntimeError("no text")

def status():
    raise NoText

def open(rate, device):
    raise NoText
"""


def test_an_error_without_a_text_hides_no_other_device(tmp_path):
    package(tmp_path, "punctura_mine", NO_TEXT)
    listed = json.loads(punctura(tmp_path, "devices", "--json").stdout)
    assert listed[0]["detail"] == "punctura_mine: NoText"
    assert "simulated" in {entry["backend"] for entry in listed}
    done = punctura(tmp_path, "run", "k06-fig10", "--headless", "--device", "mine")
    assert done.returncode == 2 and "Traceback" not in done.stderr
    assert "mine (punctura_mine) cannot be opened: NoText" in done.stderr


def test_unprintable_names_and_errors_of_a_package_do_not_reach_the_terminal(tmp_path):
    package(tmp_path, "punctura_mine", "def open(rate, device): raise ValueError('a\\0b')", name="m\x07ine")
    assert json.loads(punctura(tmp_path, "devices", "--json").stdout)[0]["backend"] == "m?ine"
    done = punctura(tmp_path, "run", "k06-fig10", "--headless", "--device", "m?ine")
    assert "cannot be opened: ValueError: a?b" in done.stderr


def test_of_two_packages_with_one_name_the_first_runs_and_the_other_is_told(of_the_docs):
    other = "def open(rate, device):\n    raise AssertionError\ndef status():\n    raise AssertionError\n"
    package(of_the_docs, "punctura_other", other)
    listed = json.loads(punctura(of_the_docs, "devices", "--json").stdout)
    assert [entry["state"] for entry in listed if entry["backend"] == "mine"] == ["available", "fault"]
    assert listed[1]["detail"].startswith(
        "punctura_other: does not run, because punctura_mine has a device of the same name; "
    )
    assert "mine" in summary_of_mine(of_the_docs, seconds="0.1")["device"]


def test_a_named_device_starts_while_another_package_hangs(of_the_docs):
    package(of_the_docs, "punctura_hangs", "import time\ndef status():\n    time.sleep(1000)\n", "hangs")
    run = ("run", "k06-fig10", "--headless", "--duration", "0.05", "--json", "--device")
    done = punctura(of_the_docs, *run, "simulated")
    assert done.returncode == 0, done.stderr
    unknown = punctura(of_the_docs, *run, "nobody")
    assert unknown.returncode == 2 and "there are: hangs, mine, " in unknown.stderr


def test_a_device_that_gives_no_reading_fails_the_run(tmp_path):
    text = (
        "from punctura.live import FedDevice\ndef open(rate, device): return FedDevice(rate)\ndef status(): return {}\n"
    )
    package(tmp_path, "punctura_mine", text)
    done = punctura(tmp_path, "run", "k06-fig10", "--headless", "--device", "mine", "--duration", "0.2", "--json")
    assert done.returncode == 1 and json.loads(done.stdout)["fault"].startswith("the device gave no reading")
    assert "never in front" not in done.stderr


def test_a_run_without_a_device_says_which_packages_it_leaves_out_and_that_it_took_the_first_device(tmp_path):
    package(tmp_path, "broken", "def open(rate, device): raise OSError\n", name="broken")
    run = ("run", "k06-fig10", "--headless", "--duration", "0.1")
    done = punctura(tmp_path, *run)
    assert done.returncode == 0, done.stderr
    assert "punctura: warning: broken is left out: broken: AttributeError: " in done.stderr
    package(tmp_path, "there", f"{OPEN}def status(): return {{'state': 'available'}}\n", name="there")
    done = punctura(tmp_path, *run)
    assert done.returncode == 2 and "(the first available device; choose another one with --device)" in " ".join(
        done.stderr.split()
    )


def test_a_signal_while_a_package_opens_its_device_ends_the_command(tmp_path):
    text = "import os, signal\ndef open(rate, device): os.kill(os.getpid(), signal.SIGTERM)\n"
    package(tmp_path, "mine", text)
    done = punctura(tmp_path, "run", "k06-fig10", "--headless", "--device", "mine")
    assert done.returncode == 128 + 15 and "ended by SIGTERM" in done.stderr
