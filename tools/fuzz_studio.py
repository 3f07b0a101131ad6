"""Fuzzes a studio with random frames, requests and HTTP for minutes, with a page connected and a recording running.

    python tools/fuzz_studio.py --minutes 10 --seed 1

The page has control, and sends random exercise files meanwhile. Passes if the studio does not end and prints no
traceback, if no request meets a defect, if its memory grows by less than 5 % in the second half, and if no tick is
lost.
"""

import argparse
import base64
import contextlib
import json
import logging
import random
import re
import socket
import sys
import tempfile
import threading
import time
from collections import Counter
from pathlib import Path
from typing import Any

from make_contract import messages
from punctura.exercise import exercise_names, load_exercise
from punctura.record import open_recording
from punctura.studio.client import StudioClient
from studio_process import Memory, StudioProcess, blank_page
from websockets.frames import Opcode
from websockets.sync.client import connect

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

# A server thread keeps the memory of its largest request, so the memory settles during the first half of a run.
WARMING_UP, MOST_GROWTH = 0.5, 0.05
PATHS = (
    "/", "/ws", "/api/recordings", "/api/recordings/small/ticks", "/api/scene.toml", "/assets/", "/api/results/x",
    "/api/lab/file", "/api/lab/identify",
)  # fmt: skip


class Fuzzer(threading.Thread):
    """Opens one connection after the other and sends random data. It never has control of the device."""

    def __init__(self, url: str, page: StudioClient, seed: int) -> None:
        super().__init__(daemon=True)
        self._random = random.Random(seed)
        self._host, self._token = page.host, page.token
        self._requests = messages()
        self.ends: Counter[str] = Counter()  # number of connections by the way they ended
        self.sent = 0
        self.stop = False

    def run(self) -> None:
        while not self.stop:
            attack = self._random.choice((self._messages, self._messages, self._raw_frames, self._http))
            with contextlib.suppress(Exception):  # disconnection is the expected result
                attack()

    def _messages(self) -> None:
        with self._socket() as opened:
            for _ in range(self._random.randint(1, 60)):
                if self.stop:
                    return
                opened.send(self._message())
                self.sent += 1
                if self._random.random() < 0.1:
                    with contextlib.suppress(TimeoutError):
                        opened.recv(timeout=0.01)
        self.ends[str(opened.close_code)] += 1

    def _raw_frames(self) -> None:
        """Sends broken WebSocket frames: wrong opcodes, wrong lengths, frames without a mask."""
        with self._socket() as opened:
            for _ in range(self._random.randint(1, 5)):
                if self._random.random() < 0.5:
                    opened.socket.sendall(self._random.randbytes(self._random.randint(1, 300)))
                else:
                    head = bytes([0x80 | self._random.choice(list(Opcode)), self._random.randint(0, 255)])
                    opened.socket.sendall(head + self._random.randbytes(self._random.randint(0, 200)))
                self.sent += 1
        self.ends["raw"] += 1

    def _http(self) -> None:
        method = self._random.choice(("GET", "POST", "DELETE", "PUT", "G\0T", "OPTIONS"))
        path = self._random.choice(PATHS) + self._random.choice(
            ("", "?token=" + self._token, "?token=%ff", "?" + "a&" * 500)
        )
        length = self._random.randint(-1, 10**6)
        size = self._random.choice((f"Content-Length: {length}", "Transfer-Encoding: chunked"))
        head = f"{method} {path} HTTP/1.1\r\nHost: {self._host}\r\n{size}\r\n\r\n"
        data = bytearray(head.encode() + self._random.randbytes(self._random.choice((0, 0, 20))))
        if self._random.random() < 0.5:
            for _ in range(self._random.randint(1, 8)):
                data[self._random.randrange(len(data))] = self._random.randrange(256)
        host, _, port = self._host.rpartition(":")
        with socket.create_connection((host, int(port)), 5) as raw:
            raw.settimeout(0.2)
            raw.sendall(bytes(data))
            self.sent += 1
            answer = raw.recv(64)
        self.ends[answer[9:12].decode("latin-1") or "nothing"] += 1

    def _message(self) -> str | bytes:
        kind = self._random.random()
        if kind < 0.1:
            return self._random.randbytes(self._random.randint(0, 2000))
        if kind < 0.15:
            return "".join(chr(self._random.randrange(1, 0xD7FF)) for _ in range(self._random.randint(0, 500)))
        pool = self._requests["requests"] + self._requests["refused"]
        request = json.loads(json.dumps(self._random.choice(pool)))
        text = json.dumps(self._mutated(request) if kind < 0.6 else request)
        if kind > 0.9:
            at = self._random.randrange(len(text))
            text = text[:at] + self._random.choice(('"', "{", "[", "9" * 400, "NaN", "\\u0000", "")) + text[at + 1 :]
        return text if '"take_control"' not in text else "{}"

    def _mutated(self, value: Any) -> Any:
        if self._random.random() < 0.15:
            return self._random.choice(
                (None, True, -1, 1e308, "", "x" * 5000, [], {}, [[[[]]]], {"a": {"b": None}}, 2**70)
            )
        if isinstance(value, dict):
            return {key: self._mutated(entry) for key, entry in value.items() if self._random.random() > 0.03}
        return [self._mutated(entry) for entry in value] if isinstance(value, list) else value

    def _socket(self) -> Any:
        return connect(
            f"ws://{self._host}/ws",
            origin=f"http://{self._host}",
            subprotocols=["punctura.v1", f"token.{self._token}"],
            compression=None,
            open_timeout=5,
            close_timeout=0.2,
            proxy=None,
        )


class Maker(threading.Thread):
    """Opens, saves, checks and deletes exercises as the page that has control. It never ends the recording."""

    def __init__(self, page: StudioClient, seed: int) -> None:
        super().__init__(daemon=True)
        self._page, self._random = page, random.Random(seed)
        self._files = [load_exercise(name).path.read_bytes() for name in exercise_names()]
        self.replies: Counter[str] = Counter()
        self.defects: list[str] = []
        self.stop = False

    def run(self) -> None:
        with contextlib.suppress(ConnectionError):
            while not self.stop:
                reply = self._page.ask(**self._request())
                self.replies["done" if reply["ok"] else "refused"] += 1
                self.defects += [reply["text"]] if reply["text"].startswith("a defect") else []
                time.sleep(0.01)

    def _request(self) -> dict[str, Any]:
        name = self._random.choice(
            ("a", "\u00e4", "../a", "con", "draft", "vein-15", "x" * 80, f"e{self._random.random()}")
        )
        kind = self._random.random()
        if kind < 0.15:
            return {"do": "delete_exercise", "name": name}
        file = self._file()
        if kind < 0.3:
            tables: object = {}
            with contextlib.suppress(ValueError, RecursionError):
                tables = json.loads(json.dumps(tomllib.loads(file.decode())))
            more = {"do": "save_exercise", "name": name} if kind < 0.2 else {"do": "check_exercise"}
            return {**more, "tables": tables}
        sent = base64.b64encode(file).decode() if kind < 0.95 else "%" + file.decode("latin-1")[:1000]
        return {"do": "open_exercise", "name": name, "file": sent, "replace": self._random.random() < 0.5}

    def _file(self) -> bytes:
        """A ready exercise, mostly with some of its bytes or numbers changed."""
        data = bytearray(self._random.choice(self._files))
        for _ in range(self._random.choice((0, 1, 1, 2, 5))):
            at = self._random.randrange(len(data))
            piece = self._random.choice((b"", b"\xff", b"\0", b"[", b'"', b"nan", b"-", b"9" * 400, b"\n", b"1e308"))
            data[at : at + self._random.choice((0, 1, 30))] = piece
        numbers = list(re.finditer(rb"(?<== )[0-9.]+", data))
        if numbers and self._random.random() < 0.5:
            found = self._random.choice(numbers)
            values = (b"nan", b"-inf", b"-0.0", b"1e308", b"5e-324", b"0.003", b"3000", b"true", b"[]", b'"3"')
            data[found.start() : found.end()] = self._random.choice(values)
        return bytes(data)


def fuzz(seconds: float, seed: int, folder: Path) -> int:
    memory = Memory(seconds, warm=WARMING_UP)
    with StudioProcess(folder, page=blank_page(folder)) as studio:
        page = StudioClient(studio.url, patience=600)  # a long recording takes a while to finish
        page.wait(lambda: page.last)
        # Requests read this small recording, because the growing one would need more memory each time.
        page.ask(do="start_recording", name="small")
        page.wait(lambda n=page.ticks: page.ticks > n + 3200)
        page.ask(do="stop_recording")
        good = page.ask(do="start_recording", name="fuzz")["ok"]
        page.ask(do="strokes", period=2.0)
        fuzzers = [Fuzzer(studio.url, page, seed + i) for i in range(2)]
        maker = Maker(page, seed)
        for thread in (*fuzzers, maker):
            thread.start()
        shown = began = time.monotonic()
        while time.monotonic() - began < seconds and studio.running and page.closed is None:
            time.sleep(0.2)
            memory.add(studio.memory_mb())
            del page.messages[:-100]
            if time.monotonic() - shown > 60:
                shown = time.monotonic()
                print(f"{shown - began:.0f} s: {studio.memory_mb():.1f} MB, {page.ticks} ticks", flush=True)
        good = good and maker.is_alive()  # an error ends it
        for thread in (*fuzzers, maker):
            thread.stop = True
        for thread in (*fuzzers, maker):
            thread.join(30)
        status = page.status()
        good = good and page.ask(do="stop_recording")["ok"]
        page.close()
        code = studio.end()
        recording = open_recording(folder / "recordings" / "fuzz.parquet")
        log = studio.log()
    ends: Counter[str] = sum((fuzzer.ends for fuzzer in fuzzers), Counter())
    print(f"{sum(f.sent for f in fuzzers)} sent, seed {seed}; ends: {dict(ends.most_common())}")
    print(f"exercises: {dict(maker.replies)}, defects: {maker.defects[:3]}")
    print(f"{recording.rows} ticks recorded, {recording.lost} lost; page: {page.gaps} gaps, {status['lost']} not shown")
    growth = memory.growth()
    print(f"memory {memory.samples[-1] if memory.samples else 0:.1f} MB, grown by {growth:+.1%}; ended with {code}")
    good = good and code == 130 and memory.flat(MOST_GROWTH) and recording.lost == page.gaps == status["lost"] == 0
    good = good and "Traceback" not in log and sum(ends.values()) > 0
    good = good and not maker.defects and maker.replies["done"] > 0 and maker.replies["refused"] > 0
    print("passed" if good else f"FAILED {log[-3000:]}")
    return 0 if good else 1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    logging.getLogger("websockets").setLevel(logging.CRITICAL + 1)  # messages of the fuzzers' side
    with tempfile.TemporaryDirectory() as folder:
        return fuzz(60 * options.minutes, options.seed, Path(folder))


if __name__ == "__main__":
    sys.exit(main())
