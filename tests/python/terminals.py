"""Terminals and pipes whose output nobody reads."""

import os
import pty
import select
import termios
from contextlib import contextmanager


@contextmanager
def unread_pipe():
    """The write end of a full pipe."""
    reading, writing = os.pipe()
    os.set_blocking(writing, False)
    try:
        while True:
            os.write(writing, b"\n" * 65536)
    except BlockingIOError:
        os.set_blocking(writing, True)
    try:
        yield writing
    finally:
        os.close(reading)
        os.close(writing)


@contextmanager
def stopped_terminal():
    """A terminal stopped by Ctrl-S."""
    with terminal() as (_, slave):
        stop(slave)
        yield slave


@contextmanager
def terminal():
    """Both ends of the terminal; programs write to the second one."""
    master, slave = pty.openpty()
    try:
        yield master, slave
    finally:
        os.close(slave)
        os.close(master)


def stop(slave):
    """Ctrl-S."""
    termios.tcflow(slave, termios.TCOOFF)


def go_on(slave):
    """Ctrl-Q."""
    termios.tcflow(slave, termios.TCOON)


def read_until(master, text, seconds=120):
    """The output up to this text, with the program's line endings."""
    shown = b""
    while text not in shown.replace(b"\r\n", b"\n"):
        assert select.select([master], [], [], seconds)[0], shown
        shown += os.read(master, 65536)
    return shown.replace(b"\r\n", b"\n").decode()


BLOCKED = {"a stopped terminal": stopped_terminal, "a pipe that nobody reads": unread_pipe}
