"""Runs a studio for minutes with four viewers, one of whom never reads, while every tick is recorded.

    python tools/soak_studio.py --minutes 30

Passes if no tick is lost in the recording nor at the viewers who read, and if the server's memory stays within 5 %.
"""

from __future__ import annotations

import argparse
import base64
import os
import socket
import sys
import tempfile
import time
from pathlib import Path

from punctura.record import open_recording
from punctura.studio.client import StudioClient
from studio_process import Memory, StudioProcess

MOST_GROWTH = 0.05


def stalled_viewer(page: StudioClient) -> socket.socket:
    """Opens the socket of a page, and never reads from it."""
    host, _, port = page.host.rpartition(":")
    raw = socket.create_connection((host, int(port)), 20)
    raw.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    key = base64.b64encode(os.urandom(16)).decode()
    raw.sendall(
        f"GET /ws HTTP/1.1\r\nHost: {page.host}\r\nOrigin: http://{page.host}\r\nUpgrade: websocket\r\n"
        f"Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n"
        f"Sec-WebSocket-Protocol: punctura.v1, token.{page.token}\r\n\r\n".encode()
    )
    return raw


def soak(seconds: float, folder: Path) -> int:
    memory = Memory(seconds)
    with StudioProcess(folder) as studio:
        pages = [StudioClient(studio.url, patience=600) for _ in range(3)]
        holder = pages[0]
        stalled = stalled_viewer(holder)
        holder.wait(lambda: holder.last)
        answer = holder.ask(do="start_recording", name="soak")
        holder.ask(do="strokes", period=4.0)
        told = began = time.monotonic()
        while (now := time.monotonic()) - began < seconds and studio.running:
            time.sleep(0.5)
            memory.add(studio.memory_mb())
            for page in pages:
                del page.messages[:-100]  # or the soak itself would grow
            if now - told > 60:
                told = now
                print(f"{now - began:.0f} s: {studio.memory_mb():.1f} MB, {[p.ticks for p in pages]} ticks", flush=True)
        status = holder.status()
        stopped = holder.ask(do="stop_recording")
        stalled.close()
        for page in pages:
            page.close()
        code = studio.end()
        recording = open_recording(folder / "recordings" / "soak.parquet")
        gaps, said = sum(page.gaps for page in pages), studio.said()
    growth = memory.growth()
    print(
        f"{status['viewers']} viewers; {recording.rows} ticks recorded, {recording.lost} lost; gaps at viewers: {gaps}"
    )
    print(f"late {status['late']}, not shown {status['lost']}; the studio ended with {code}")
    largest = max(memory.samples, default=float("nan"))
    print(
        f"memory: {memory.samples[0] if memory.samples else 0:.1f} MB, at most {largest:.1f} MB, grown by {growth:+.1%}"
    )
    good = answer["ok"] and stopped["ok"] and recording.finished and status["viewers"] == 4 and code == 130
    good = (
        good
        and memory.flat(MOST_GROWTH)
        and recording.lost == 0
        and gaps == 0
        and status["lost"] == 0
        and "Traceback" not in said
    )
    print("passed" if good else f"FAILED {said[-2000:]}")
    return 0 if good else 1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=30.0)
    minutes = parser.parse_args().minutes
    with tempfile.TemporaryDirectory() as folder:
        return soak(60 * minutes, Path(folder))


if __name__ == "__main__":
    sys.exit(main())
