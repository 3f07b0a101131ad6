"""Makes the standard streams safe: neither a closed stream nor an unread one changes what a command does."""

import errno
import io
import os
import signal
import sys
from contextlib import suppress
from typing import Any, NoReturn, cast

from punctura.cli._status import SIGNAL
from punctura.process.dropping_stream import DroppingStream, terminal
from punctura.process.signals import Ended, ignore_more_signals


def open_closed_streams() -> None:
    """Replaces a closed stream (`2>&-`) by the null device; else the next file would get its descriptor."""
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
    """Its errors name standard output; the system's errors have no name for it."""

    def write(self, data: Any) -> int:
        try:
            return super().write(data)
        except OSError as error:
            if error.errno == errno.EPIPE:  # the reader has closed the pipe, as in `punctura ... | head`
                raise
            raise StdoutError(error.errno, error.strerror) from None


def name_stdout() -> None:
    """From here on, errors of sys.stdout (such as a full disk) name standard output."""
    plain = sys.stdout
    if not isinstance(plain, io.TextIOWrapper):
        return
    raw = getattr(plain.buffer, "raw", plain.buffer)  # a stream without a buffer (python -u) is raw itself
    if type(raw) is not io.FileIO:  # a console on Windows, or an object of another program
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
    """From here on, sys.stderr drops text that is not read in time. Returns that stream."""
    sys.stderr = terminal()
    return cast(DroppingStream, sys.stderr)


def wait_for_stderr_again() -> None:
    """Restores the stream at the end of a command, once its text is written or its reader has stopped reading."""
    stream = sys.stderr
    if isinstance(stream, DroppingStream):
        stream.end()
        sys.stderr = stream.stream


def give_up_stdout() -> None:
    """Drops unwritten text of sys.stdout: at the end it would block the program, or change the exit status."""
    with suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


def leave(end: Ended, more: str = "") -> NoReturn:
    """Prints the signal's name, and exits with its status."""
    ignore_more_signals()
    give_up_stdout()
    words = "interrupted" if end.number == signal.SIGINT else f"ended by {end.name}"
    print(f"punctura: {words}{more}", file=sys.stderr)
    sys.exit(SIGNAL + end.number)
