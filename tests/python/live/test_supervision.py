"""A run ends on request, whatever the terminal and the caller's code do at that time."""

import contextlib
import ctypes
import json
import os
import signal
import subprocess
import sys
import threading

import punctura as pn
import pytest
from heed import heed_signals
from punctura.live import DeviceInfo, FedDevice, SimulatedDevice, run_live
from punctura.process.signals import Ended
from punctura.record import open_recording
from punctura.simulation import Target
from terminals import BLOCKED, stop, terminal, unread_pipe
from waiting import PATIENCE_S

SCENE = pn.load_scene("k06-fig10")
RUN = [sys.executable, "-m", "punctura", "run", "--headless", "--device", "simulated"]

# Says on stdout what happens to its loop, while its main thread writes to a pipe that nobody reads.
BLOCKED_PROGRAM = """
import os, sys, threading, time
import punctura as pn
from punctura.live import DeviceInfo, Ended, FedDevice, run_live

why = sys.argv[1]

def say(text):
    os.write(1, text.encode() + b"\\n")

def observe(loop):
    while not loop.running:
        time.sleep(1e-3)
    while loop.running:
        time.sleep(1e-3)
    say("stopped")

def prepare(loop):
    threading.Thread(target=observe, args=[loop], daemon=True).start()
    return lambda: say("finished")

def wait_for_ever(summary):
    if why == "ticks cease":
        device.feed((0, 5e-3, 0))  # and no more
    while True:
        try:
            say("waits")
            sys.stderr.write("x" * 1_000_000)
        except BaseException as error:
            say(type(error).__name__)

device = FedDevice(rate=1600, info=DeviceInfo(model="a stylus"))
run_live(device, pn.load_scene("k06-fig10"), 0.2 if why == "its time" else None, watch=wait_for_ever, prepare=prepare)
"""


@pytest.mark.parametrize("why", ["ticks cease", "its time", "a signal"])
def test_a_run_is_stopped_while_its_caller_waits_for_ever(why):
    with unread_pipe() as stderr:
        command = [sys.executable, "-c", BLOCKED_PROGRAM, why]
        process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=stderr, text=True, bufsize=1, preexec_fn=heed_signals
        )
        watchdog = threading.Timer(30, process.kill)
        watchdog.start()
        try:
            assert process.stdout.readline() == "waits\n"
            wanted = {"stopped\n"}
            if why == "a signal":
                process.send_signal(signal.SIGTERM)
                wanted.add("Ended\n")  # which the caller takes for an error, and goes on waiting
            for line in iter(process.stdout.readline, "finished\n"):
                wanted.discard(line)
                if not line or not wanted:
                    break
            assert not wanted
        finally:
            watchdog.cancel()
            process.kill()
            process.communicate()


def test_ticks_that_cease_end_a_run_also_in_another_thread():
    device = FedDevice(rate=1600, info=DeviceInfo(model="a stylus"))
    feed_once = lambda summary: device.fed or device.feed((0, 5e-3, 0))  # noqa: E731
    found = []
    thread = threading.Thread(target=lambda: found.append(run_live(device, SCENE, watch=feed_once).fault), daemon=True)
    thread.start()
    thread.join(PATIENCE_S)
    assert found and found[0].startswith("the device's ticks have ceased")


@pytest.mark.skipif(os.name == "nt", reason="needs usleep of the C library")
def test_a_watch_that_holds_the_gil_does_not_hold_up_the_end():
    device = SimulatedDevice(Target((0, 5e-3, 0)), rate=1000)
    hold, held, times = ctypes.PyDLL(None).usleep, [], []

    def prepare(loop):
        listener = loop.listen()
        return lambda: times.extend(listener.read()["time"])

    def watch(summary):
        if not held:
            held.append(hold(900_000))  # microseconds; a call through PyDLL keeps the GIL

    assert run_live(device, SCENE, 0.3, watch=watch, prepare=prepare).fault == ""
    assert times and max(times) < 0.3


@pytest.mark.parametrize("blocked", BLOCKED)
def test_the_command_ends_after_its_time_while_nobody_reads_its_messages(tmp_path, blocked):
    command = [*RUN, "--duration", "1", "--record", str(tmp_path / "run.parquet"), "--json"]
    with BLOCKED[blocked]() as stderr:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=stderr, text=True, timeout=PATIENCE_S)
    assert done.returncode == 0
    assert json.loads(done.stdout)["recording"]["lost"] == 0
    assert open_recording(tmp_path / "run.parquet").finished


def test_a_termination_ends_the_command_while_its_terminal_is_stopped(tmp_path):
    part = tmp_path / "run.parquet.part"
    with terminal() as (_, slave):
        process = subprocess.Popen(
            [*RUN, "--record", str(tmp_path / "run.parquet")],
            stdin=slave,
            stdout=slave,
            stderr=slave,
            preexec_fn=heed_signals,
        )
        try:
            size_of(part, 20_000, process)
            stop(slave)
            size_of(part, part.stat().st_size + 60_000, process)  # the line has long been due
            process.send_signal(signal.SIGTERM)
            assert process.wait(PATIENCE_S) == 128 + signal.SIGTERM
        finally:
            process.kill()
            process.wait()
    assert open_recording(tmp_path / "run.parquet").finished


def size_of(part, least, process):
    while not part.exists() or part.stat().st_size < least:
        assert process.poll() is None
        threading.Event().wait(0.01)


def test_a_result_that_was_asked_for_is_whole_however_late_it_is_read():
    process = subprocess.Popen(
        [*RUN, "--duration", "0.2", "--json"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, bufsize=0
    )
    os.set_blocking(process.stdout.fileno(), True)
    printed = b""
    while piece := os.read(process.stdout.fileno(), 7):
        printed += piece
    assert process.wait(PATIENCE_S) == 0 and json.loads(printed)["ticks"] > 0


def test_a_termination_ends_a_command_whose_result_nobody_reads(tmp_path):
    with unread_pipe() as stdout:
        command = [*RUN, "--duration", "0.2", "--record", str(tmp_path / "run.parquet"), "--json"]
        process = subprocess.Popen(
            command, stdout=stdout, stderr=subprocess.PIPE, text=True, bufsize=1, preexec_fn=heed_signals
        )
        try:
            while " ticks recorded" not in (line := process.stderr.readline()):
                assert line
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(1)  # by now it writes its result
            for _ in range(100):  # one that comes just before the command begins to wait does not end the wait
                process.send_signal(signal.SIGTERM)
                with contextlib.suppress(subprocess.TimeoutExpired):
                    assert process.wait(0.3) == 128 + signal.SIGTERM
                    break
            assert process.returncode is not None
        finally:
            process.kill()
            process.communicate()


class Interrupts:
    """Sends a signal to this process before the n-th line that the main thread executes in these files."""

    FILES = (
        "/live/session.py",
        "/live/summary.py",
        "/live/supervisor.py",
        "/process/signals.py",
        "/contextlib.py",
    )

    def __init__(self, n):
        self.left = n

    def __call__(self, frame, event, _):
        if not frame.f_code.co_filename.endswith(self.FILES):
            return None
        if event == "line":
            self.left -= 1
            if self.left == 0:
                signal.raise_signal(signal.SIGTERM)
        return self


def interrupted_run(n):
    """A short run with a signal before the n-th line. Returns the result, and whether n lines were executed."""
    device = SimulatedDevice(Target([0, 5e-3, 0]), real_time=False, ticks=20)
    happened, loops = [], []

    def prepare(loop):
        loops.append(loop)
        return lambda: happened.append("finished")

    before = signal.signal(signal.SIGTERM, lambda *_: happened.append("not ours"))
    interrupts = Interrupts(n)
    sys.settrace(interrupts)
    try:
        run_live(device, SCENE, prepare=prepare)
    except Ended as end:
        happened.append("Ended")
        assert end.summary is None or end.summary.lost == 0, f"line {n}: the summary lacks ticks"
    finally:
        sys.settrace(None)
        left_behind = signal.signal(signal.SIGTERM, before)
    assert not any(loop.running for loop in loops), f"line {n}"
    assert happened.count("finished") == len(loops), f"line {n}: {happened}"
    assert left_behind.__name__ == "<lambda>", f"line {n}"
    return happened, interrupts.left <= 0


def test_no_instant_exists_in_which_a_signal_leaves_the_loop_running_or_its_recording_unfinished():
    heard, n = 0, 1
    while True:
        happened, reached = interrupted_run(n)
        if not reached:
            break
        assert ("Ended" in happened) != ("not ours" in happened), f"line {n}: {happened}"
        heard += "Ended" in happened
        n += 1
    assert heard > 50
