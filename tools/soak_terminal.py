"""Checks that runs with blocked output neither wait nor grow nor lose a tick.

    python tools/soak_terminal.py --seconds 60

Three runs record at the same time: one in a stopped terminal (Ctrl-S), one whose standard error is a full pipe, and a
studio in a stopped terminal whose server logs a line for each request of a flood. "pause" is sent to the studio twice
per second. At the end the studio's terminal continues and is stopped again, and each run gets a signal.

Passes if no tick is lost, if no memory grows by more than 10 % in the last 70 % of two minutes or more, if "pause" is
always answered within 2 s, and if each run ends within a minute with the signal's status and a complete recording. On
an idle computer "pause" takes a few milliseconds; judge by the printed times. Linux and macOS only.
"""

from __future__ import annotations

import argparse
import os
import select
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from punctura.record import open_recording
from punctura.studio.client import StudioClient
from resident import resident_mb
from studio_process import Memory, StudioProcess, blank_page

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "python"))

from terminals import go_on, stop, stopped_terminal, terminal, unread_pipe

MOST_GROWTH, WARM = 0.1, 0.3  # largest growth of memory, measured after this share of the time
MOST_ANSWER_S = 2.0
MOST_END_S = 60.0  # includes finishing a long recording
FLOODERS = 4
ASK_EVERY_S = 0.5
LOGGED = b"Unsupported upgrade request."


class Headless:
    """`punctura run --headless` whose output nobody reads."""

    def __init__(self, name: str, folder: Path, stderr: int, seconds: float) -> None:
        self.name, self.path = name, folder / f"{name.replace(' ', '-')}.parquet"
        command = [sys.executable, "-m", "punctura", "run", "--headless", "--device", "simulated"]
        command += ["--record", str(self.path)]
        self._process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=stderr)
        self.memory = Memory(seconds, WARM)

    def look(self) -> None:
        self.memory.add(resident_mb(self._process.pid))

    def end(self) -> bool:
        began = time.monotonic()
        self._process.send_signal(signal.SIGTERM)
        try:
            code = self._process.wait(60)
        except subprocess.TimeoutExpired:
            self._process.kill()
            code = self._process.wait()
        return report(self.name, self.memory, code, time.monotonic() - began, 128 + signal.SIGTERM, self.path)


def report(name: str, memory: Memory, code: int, took: float, expected: int, path: Path) -> bool:
    """Prints the results of a run and returns whether they are right."""
    last = memory.samples[-1] if memory.samples else float("nan")
    print(f"{name}: {last:.1f} MB, grown by {memory.growth():+.1%}; ended with {code} in {took:.2f} s")
    if not path.exists():
        print(f"{name}: NO RECORDING")
        return False
    recording = open_recording(path)
    print(f"{name}: {recording.rows} ticks recorded, {recording.lost} lost")
    whole = recording.finished and recording.lost == 0 and recording.rows > 0
    return whole and code == expected and took < MOST_END_S and memory.flat(MOST_GROWTH)


class Flood:
    """Sends requests without a token, one after the other. The server logs a warning for each."""

    def __init__(self, port: int) -> None:
        self.sent = 0
        self._port, self._over = port, threading.Event()
        self._threads = [threading.Thread(target=self._work, daemon=True) for _ in range(FLOODERS)]
        for thread in self._threads:
            thread.start()

    def _work(self) -> None:
        request = f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{self._port}\r\nConnection: upgrade\r\nUpgrade: none\r\n\r\n"
        while not self._over.is_set():
            try:
                with socket.create_connection(("127.0.0.1", self._port), 5) as connection:
                    connection.sendall(request.encode())
                    while connection.recv(4096) and not self._over.is_set():
                        self.sent += 1
                        connection.sendall(request.encode())
            except OSError:  # refused, reset or late: open another connection
                pass

    def end(self) -> None:
        self._over.set()
        for thread in self._threads:
            thread.join()


def drained(master: int, slave: int) -> list[bytes]:
    """Continues the terminal, reads its output until there is none for a second, and stops it again."""
    output = b""
    go_on(slave)
    while select.select([master], [], [], 1)[0]:
        output += os.read(master, 65536)
    stop(slave)
    return output.splitlines()


def soak(seconds: float, folder: Path) -> int:
    with stopped_terminal() as quiet, unread_pipe() as full, terminal() as ends:
        stop(ends[1])
        runs = [
            Headless("stopped terminal", folder, quiet, seconds),
            Headless("unread stderr", folder, full, seconds),
        ]
        return soak_beside(runs, ends, seconds, folder)


def soak_beside(runs: list[Headless], ends: tuple[int, int], seconds: float, folder: Path) -> int:
    """ends: the two ends of the studio's stopped terminal. The studio writes to the second."""
    memory, answers = Memory(seconds, WARM), []
    master, slave = ends
    with StudioProcess(folder, page=blank_page(folder), terminal=slave) as studio:
        flood = Flood(studio.port)
        with StudioClient(studio.url, patience=60) as page:
            good = bool(page.ask(do="start_recording", name="soak")["ok"])
            began = time.monotonic()
            while time.monotonic() - began < seconds and studio.running:
                asked = time.monotonic()
                good = page.ask(do="pause")["ok"] and good
                answers.append(time.monotonic() - asked)
                page.ask(do="arm")
                del page.messages[:-100]  # limits the memory of this program
                memory.add(studio.memory_mb())
                for run in runs:
                    run.look()
                time.sleep(ASK_EVERY_S)
            page.ask(do="stop_recording")
        flood.end()
        lines = drained(master, slave)
        began = time.monotonic()
        code = studio.end()
        took = time.monotonic() - began
    logged, left_out = sum(LOGGED in line for line in lines), [line for line in lines if b"left out here" in line]
    good = all([run.end() for run in runs]) and good
    path = folder / "recordings" / "soak.parquet"
    good = report("flooded studio", memory, code, took, 128 + signal.SIGINT, path) and good
    median = statistics.median(answers)
    print(
        f'"pause" was answered {len(answers)} times: median {median * 1e3:.1f} ms, largest {max(answers) * 1e3:.1f} ms'
    )
    print(f"{flood.sent} requests to log; then the terminal showed {logged} of their lines, and these notes:")
    print("\n".join(f"  {line.decode()}" for line in left_out) or "  no note about left-out lines")
    good = good and max(answers) < MOST_ANSWER_S and logged > 0
    print("passed" if good else "FAILED")
    return 0 if good else 1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=60.0)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        return soak(options.seconds, Path(folder))


if __name__ == "__main__":
    sys.exit(main())
