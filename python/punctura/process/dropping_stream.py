"""A text stream that never waits for its reader: text that is not read in time is dropped and counted."""

import atexit
import io
import math
import os
import signal
import sys
import threading
import time
from collections import deque
from contextlib import suppress
from typing import Any, TextIO, cast

ROOM_BYTES = 1 << 16
CUT = " ... punctura: the rest of this line is left out: it is too long"
LINGER_S = 1.0  # the longest time that the end of the program waits for the reader
RETRY_S = 0.05


class DroppingStream(io.TextIOBase):
    """Writes to another stream's file descriptor, in a thread of its own; `write` and `flush` never wait.

    A stopped terminal (Ctrl-S), or a pipe that nobody reads, blocks only that thread. It writes without Python's
    locks, so that the end of the program does not wait for it.
    """

    def __init__(self, stream: TextIO, room: int = ROOM_BYTES) -> None:
        """room: the most bytes that wait for the reader; above it, the oldest lines are dropped.

        A single longer line is cut to this many bytes, with a note.
        """
        self.stream = stream  # kept, because it would close its file
        self._raw: Any = getattr(stream.buffer, "raw", stream.buffer)  # a stream without a buffer is raw itself
        self._encoding = stream.encoding
        self._room = room
        self._change = threading.Condition()  # reentrant, because a signal handler may write
        self._pieces: deque[bytes] = deque()
        self._bytes = 0  # that wait, or are being written
        self._begun = b""  # of a line
        self._cut = False  # that line is longer than the room
        self._dropped = 0  # lines, before the first piece that waits
        self._since = math.inf  # when the write began that waits
        self._over = False
        self._thread: threading.Thread | None = None
        atexit.register(self._leave)

    def __repr__(self) -> str:
        return f"<DroppingStream to {self.stream}: {self._dropped} lines dropped>"

    def write(self, text: str) -> int:
        if not isinstance(text, str):
            raise TypeError(f"text is needed, not {type(text).__name__}")
        if not self._over:  # at the very end a thread that was cut off may have the lock
            with self._change:
                *lines, rest = text.split("\n")
                for line in lines:
                    self._add(line)
                    self._put(self._taken("\n"))
                self._add(rest)
        return len(text)

    def flush(self) -> None:
        """Passes on the line as far as it was written. Does not wait until it is read."""
        if self._begun and not self._over:
            with self._change:
                self._put(self._taken())

    def offer(self, text: str) -> bool:
        """Takes the text only if nothing else waits: for a status line, where only the newest text matters."""
        with self._change:
            if self._bytes or self._over:
                return False
            self._put(self._encoded(text)[: self._room])
            return True

    def end(self, seconds: float = LINGER_S) -> None:
        """Closes the stream. Waits for the reader for this time, unless it stopped reading long ago."""
        self.flush()
        with self._change:
            now = time.monotonic()
            self._change.wait_for(lambda: self._bytes == 0 or self._over, min(now, self._since) + seconds - now)
            self._over = True

    def _leave(self) -> None:
        """For the end of the program, when the interpreter or a C library may write to the same file."""
        self.end()
        if self._bytes:
            with suppress(OSError, ValueError):
                nowhere = os.open(os.devnull, os.O_WRONLY)
                os.dup2(nowhere, self.fileno())
                os.close(nowhere)

    def _encoded(self, text: str) -> bytes:
        return text.encode(self._encoding, "backslashreplace")

    def _add(self, text: str) -> None:
        """Appends to the present line, as far as there is space."""
        if self._cut:
            return
        left = self._room - len(self._begun)
        data = self._encoded(text[: left + 1])  # a character has a byte at least
        if len(data) > left:
            self._cut = True
            data = self._encoded(data[:left].decode(self._encoding, "ignore"))  # whole characters
        self._begun += data

    def _taken(self, end: str = "") -> bytes:
        """Ends the present line."""
        data = self._begun + self._encoded((CUT if self._cut else "") + end)
        self._begun, self._cut = b"", False
        return data

    def _put(self, data: bytes) -> None:
        self._pieces.append(data)
        self._bytes += len(data)
        while self._bytes > self._room and len(self._pieces) > 1:
            oldest = self._pieces.popleft()
            self._bytes -= len(oldest)
            self._dropped += oldest.count(b"\n") or 1
        self._change.notify_all()
        if self._thread is None:
            self._thread = threading.Thread(target=self._work, name="punctura-terminal", daemon=True)
            with suppress(RuntimeError):  # the system has no thread left, or the program is ending
                self._thread.start()

    def _next(self) -> bytes:
        """The next piece to write; if lines were dropped, their number first."""
        while not self._pieces:
            self._change.wait()
        if self._dropped == 0:
            return self._pieces.popleft()
        count, self._dropped = self._dropped, 0
        notice = f"punctura: {count} line{'s' if count > 1 else ''} left out here: nobody read in time\n".encode()
        self._bytes += len(notice)
        return notice

    def _work(self) -> None:
        if hasattr(signal, "SIGTTOU"):  # else a terminal may suspend the whole program for writing in the background
            signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTTOU})
        while not self._over:
            with self._change:
                data = self._next()
                self._since = time.monotonic()
            whole = self._write_whole(data)
            with self._change:
                self._since = math.inf
                self._bytes -= len(data)
                self._over = self._over or not whole
                self._change.notify_all()

    def _write_whole(self, data: bytes) -> bool:
        """Waits for the reader. False: it has gone."""
        rest = memoryview(data)
        with suppress(OSError, ValueError):
            while rest:
                count = self._raw.write(rest)
                if count is None:  # another program has made the terminal non-blocking
                    time.sleep(RETRY_S)
                else:
                    rest = rest[count:]
        return not rest

    def writable(self) -> bool:
        return True

    def isatty(self) -> bool:
        return bool(self._raw.isatty())

    def fileno(self) -> int:
        return int(self._raw.fileno())

    @property
    def encoding(self) -> str:  # type: ignore[override]
        return self._encoding

    @property
    def errors(self) -> str:  # type: ignore[override]
        return "backslashreplace"


_terminal: DroppingStream | None = None


def terminal() -> TextIO:
    """The one queue for sys.stderr: sys.stderr itself where it never waits. A new one when sys.stderr is another."""
    global _terminal
    stream = cast(TextIO | None, sys.stderr)
    if isinstance(stream, DroppingStream) or stream is None:
        return cast(TextIO, stream or io.StringIO())
    if _terminal is None or _terminal.stream is not stream or _terminal._over:
        _terminal = DroppingStream(stream)
    return cast(TextIO, _terminal)
