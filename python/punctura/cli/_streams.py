"""The standard streams, so that neither a closed one nor one that nobody reads changes what a command does."""

from __future__ import annotations

import errno
import io
import os
import sys
from contextlib import suppress
from typing import Any, TextIO, cast

from punctura.live import DroppingStream


def open_closed_streams() -> None:
    """A stream that was closed (`2>&-`) becomes one that keeps nothing; else the next file would get its number."""
    nowhere = os.open(os.devnull, os.O_RDWR)
    while nowhere <= 2:
        nowhere = os.dup(nowhere)
    os.close(nowhere)
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w"))  # noqa: SIM115


class StdoutError(OSError):
    """Standard output cannot be written; errno says why."""

    def __str__(self) -> str:
        return f"standard output cannot be written: {self.strerror}"


class _NamedStdout(io.FileIO):
    """Its errors say that it is standard output: those of the system have no name for it."""

    def write(self, data: Any) -> int:
        try:
            return super().write(data)
        except OSError as error:
            if error.errno == errno.EPIPE:  # a reader that has seen enough, as in `punctura ... | head`
                raise
            raise StdoutError(error.errno, error.strerror) from None


def name_stdout() -> None:
    """From here on an error of sys.stdout, as on a full disk, says that it is standard output."""
    plain = sys.stdout
    if not isinstance(plain, io.TextIOWrapper):
        return
    raw = getattr(plain.buffer, "raw", plain.buffer)  # a stream without a buffer (python -u) is raw itself
    if type(raw) is not io.FileIO:  # a console on Windows, or what a program has put there
        return
    named: Any = _NamedStdout(raw.fileno(), "wb", closefd=False)
    sys.stdout = io.TextIOWrapper(
        named if raw is plain.buffer else io.BufferedWriter(named),
        plain.encoding,
        plain.errors,
        line_buffering=plain.line_buffering,
        write_through=plain.write_through,
    )


def never_wait_for_stderr() -> DroppingStream:
    """From here on sys.stderr, which is returned, drops what its reader does not take in time."""
    if not isinstance(sys.stderr, DroppingStream):
        sys.stderr = cast(TextIO, DroppingStream(sys.stderr))
    return cast(DroppingStream, sys.stderr)


def wait_for_stderr_again() -> None:
    """Undoes that at the end of a command, once what waits is written or its reader has long stopped reading."""
    stream = sys.stderr
    if isinstance(stream, DroppingStream):
        stream.end()
        sys.stderr = stream.stream


def give_up_stdout() -> None:
    """What waits in sys.stdout is thrown away: at the end of the program it would block, or change the exit status."""
    with suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
