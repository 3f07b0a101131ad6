"""However a run ends, the force is switched off and the recording is complete."""

import json
import os
import pty
import signal
import subprocess
import sys
import threading
import time

import punctura as pn
import pytest
from heed import heed_signals
from punctura._core import DeviceInfo, FedDevice, ServoLoop
from punctura.cli._headless import Tape
from punctura.live import run_live
from punctura.live.supervisor import Supervisor
from punctura.record import open_recording
from waiting import PATIENCE_S, wait_until

SCENE_NAME = pn.load_scene("venipuncture").name
SCENE = pn.load_scene("k06-fig10")
RUN = [sys.executable, "-m", "punctura", "run", "--headless", "--device", "simulated"]


def running(path, *options, **more):
    """A recording run, after the first ticks are on the disk."""
    command = [*RUN, "--record", str(path), *options]
    process = subprocess.Popen(
        command,
        text=True,
        **({"stderr": subprocess.PIPE, "stdout": subprocess.PIPE, "preexec_fn": heed_signals} | more),
    )
    part = path.with_name(path.name + ".part")
    wait_until(lambda: (part.exists() and part.stat().st_size >= 60_000) or process.poll() is not None)
    assert process.poll() is None
    return process


RARE = [pytest.param(name, marks=pytest.mark.statistics) for name in ("SIGINT", "SIGQUIT", "SIGTSTP")]


@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP", *RARE])
def test_a_signal_ends_the_run_and_a_second_one_cuts_nothing_short(tmp_path, name):
    path = tmp_path / "run.parquet"
    process = running(path)
    number = getattr(signal, name)
    for _ in range(3):
        process.send_signal(number)
        time.sleep(0.02)
    printed, report = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 128 + number
    assert " 0 lost" in report and "leaked" not in report and "Traceback" not in report
    recording = open_recording(path)
    assert recording.finished
    assert printed.startswith(f"{SCENE_NAME} on simulated: ") and f"\n  {recording.rows} ticks at 1600 Hz" in printed


def test_the_summary_after_a_signal_is_whole_and_a_reader_that_does_not_read_delays_nothing(tmp_path):
    path = tmp_path / "run.parquet"
    process = running(path, "--json")
    process.send_signal(signal.SIGINT)
    result = json.loads(process.communicate(timeout=PATIENCE_S)[0])
    assert process.returncode == 128 + signal.SIGINT
    assert result["ticks"] == result["recording"]["rows"] > 0 and result["recording"]["finished"]

    read, write = os.pipe()
    os.set_blocking(write, False)
    with pytest.raises(BlockingIOError):
        while True:
            os.write(write, bytes(1 << 16))
    os.set_blocking(write, True)
    process = running(tmp_path / "full.parquet", stdout=write)
    process.send_signal(signal.SIGINT)
    assert process.wait(PATIENCE_S) == 128 + signal.SIGINT
    os.close(read)
    os.close(write)


def test_another_signal_right_after_the_first_cuts_nothing_short(tmp_path):
    path = tmp_path / "run.parquet"
    process = running(path)
    process.send_signal(signal.SIGHUP)
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=PATIENCE_S)
    assert process.returncode in (128 + signal.SIGHUP, 128 + signal.SIGTERM)
    assert open_recording(path).finished


def ignore_hangup():
    heed_signals()
    signal.signal(signal.SIGHUP, signal.SIG_IGN)


def test_what_the_caller_ignores_does_not_end_the_run(tmp_path):
    path = tmp_path / "run.parquet"
    process = running(path, preexec_fn=ignore_hangup)
    process.send_signal(signal.SIGHUP)
    time.sleep(0.3)
    assert process.poll() is None
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 128 + signal.SIGTERM


def test_a_closed_terminal_ends_the_run_and_its_recording_is_whole(tmp_path):
    path = tmp_path / "run.parquet"
    master, slave = pty.openpty()
    buffered = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    process = running(path, stdin=slave, stdout=slave, stderr=slave, start_new_session=True, env=buffered)
    os.close(slave)
    os.close(master)  # what is written from now on fails, as after a window was closed
    process.send_signal(signal.SIGHUP)
    assert process.wait(PATIENCE_S) == 128 + signal.SIGHUP
    assert open_recording(path).finished


def full_disk():
    import resource

    resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000))


def test_a_recording_that_lost_ticks_fails_the_command_and_is_in_its_summary(tmp_path):
    command = [*RUN, "--record", str(tmp_path / "run.parquet"), "--duration", "2", "--json"]
    done = subprocess.run(command, text=True, capture_output=True, timeout=PATIENCE_S, preexec_fn=full_disk)
    assert done.returncode == 1
    result = json.loads(done.stdout)["recording"]
    assert result["lost"] > 0 and not result["finished"] and result["trouble"]
    assert f"{result['lost']} lost" in done.stderr


def once(device):
    """For `watch`: feeds one reading, and no more."""
    return lambda summary: device.fed or device.feed((0.0, 5e-3, 0.0))


def test_the_driver_is_asked_what_is_wrong_only_after_the_stop(monkeypatch):
    reported, asked = threading.Event(), []
    device = FedDevice(rate=1600, info=DeviceInfo(model="a stylus"))

    class LateStop(Supervisor):
        """Stops only after the run's thread has reported the fault."""

        def __init__(self, signals, begin, over, end):
            super().__init__(signals, begin, over, lambda: reported.wait(PATIENCE_S) and end())

    def add_trouble(summary, device, thumb=None):
        asked.append(reported.is_set())
        summary.fault += ": the cable is out"

    monkeypatch.setattr("punctura.live.session.Supervisor", LateStop)
    monkeypatch.setattr("punctura.live.RunSummary.add_trouble", add_trouble)
    faults = []

    def watch(summary):
        once(device)(summary)
        faults.append(summary.fault)
        if summary.fault:
            reported.set()

    run_live(device, SCENE, watch=watch)
    first = next(fault for fault in faults if fault)
    assert first.endswith("switch it off") and asked and all(asked)
    assert faults[-1].endswith("switch it off: the cable is out")


def test_what_the_driver_says_later_is_told_after_the_fault(capsys):
    class Line:
        def end(self):
            pass

    tape = Tape(None, Line())
    for fault in ("ticks have ceased", "ticks have ceased", "ticks have ceased: the cable is out"):
        tape.report_fault(fault)
    assert capsys.readouterr().err == "punctura: ticks have ceased\npunctura: the cable is out\n"


def test_a_run_whose_ticks_cease_ends_with_a_fault():
    device = FedDevice(rate=1600, info=DeviceInfo(model="a stylus"))
    assert run_live(device, SCENE, duration=0.3).fault == ""  # the first reading may come late
    summary = run_live(device, SCENE, duration=60, watch=once(device))
    assert summary.fault.startswith("the device's ticks have ceased")
    assert device.feed([0, 0, 0]) == (0, 0, 0)  # no loop takes it any more


def test_a_loop_in_a_with_block_is_stopped_however_the_block_ends():
    device = FedDevice(rate=1600)
    with pytest.raises(KeyError), ServoLoop(device, SCENE) as loop:
        loop.start()
        assert loop.running
        raise KeyError
    assert not loop.running


def test_the_end_of_a_program_stops_a_loop_that_a_daemon_thread_still_holds():
    program = """
import atexit, threading, time
gone = threading.Event()
atexit.register(lambda: print("stopped" if gone.wait(20) else "runs on", flush=True))  # called last
import punctura as pn
from punctura.live import ServoLoop, SimulatedDevice
from punctura.simulation import Target

held = threading.Event()
def hold():
    loop = ServoLoop(SimulatedDevice(Target([0, 5e-3, 0])), pn.load_scene("k06-fig10"))
    loop.start()
    held.set()
    while loop.running:
        time.sleep(1e-3)
    gone.set()
threading.Thread(target=hold, daemon=True).start()
held.wait()
"""
    done = subprocess.run([sys.executable, "-c", program], text=True, capture_output=True, timeout=PATIENCE_S)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "stopped\n"


# A signal comes while the file of a recording is finished, or as soon as the file is made.
SIGNAL_AT_THE_FILE = """
import os, signal, sys
import punctura.record.recorder as recorder
from punctura.cli import main

at, number = sys.argv[1], getattr(signal, sys.argv[2])
whole = getattr(recorder, at)

def spoilt(*arguments):
    made = whole(*arguments) if at == "AppendFile" else None
    os.kill(os.getpid(), number)
    return made or whole(*arguments)

setattr(recorder, at, spoilt)
main(["run", "--headless", "--device", "simulated", "--duration", "0.2", "--record", sys.argv[3]])
"""


@pytest.mark.parametrize(
    ("at", "name"),
    [("finish_recording", "SIGHUP"), ("AppendFile", "SIGTERM")],
)
def test_a_recording_is_finished_when_a_first_signal_comes_at_its_file(tmp_path, at, name):
    path = tmp_path / "run.parquet"
    command = [sys.executable, "-c", SIGNAL_AT_THE_FILE, at, name, str(path)]
    done = subprocess.run(command, text=True, capture_output=True, timeout=PATIENCE_S, preexec_fn=heed_signals)
    assert done.returncode == 128 + getattr(signal, name)
    assert f"punctura: {path}: " in done.stderr and "Traceback" not in done.stderr
    assert [p.name for p in tmp_path.iterdir()] == ["run.parquet"]
    assert open_recording(path).finished


def close_stderr():
    os.close(2)


def test_a_closed_standard_error_changes_nothing_but_what_is_said(tmp_path):
    path = tmp_path / "run.parquet"
    command = [*RUN, "--duration", "0.2", "--record", str(path), "--json"]
    done = subprocess.run(command, text=True, stdout=subprocess.PIPE, timeout=PATIENCE_S, preexec_fn=close_stderr)
    assert done.returncode == 0 and json.loads(done.stdout)["recording"]["finished"]
    assert [p.name for p in tmp_path.iterdir()] == ["run.parquet"]


def test_a_terminal_that_has_gone_leaves_the_exit_status_of_a_run_that_ends_by_itself(tmp_path):
    path = tmp_path / "run.parquet"
    master, slave = pty.openpty()
    process = running(path, "--duration", "6", stdin=slave, stdout=slave, stderr=slave, preexec_fn=ignore_hangup)
    os.close(slave)
    os.close(master)
    assert process.wait(PATIENCE_S) == 0
    assert open_recording(path).finished
