"""A stream that drops lines instead of waiting."""

import io
import os
import subprocess
import sys

import pytest
from punctura.live import DroppingStream
from punctura.process.dropping_stream import CUT
from terminals import BLOCKED, go_on, read_until, stop, terminal
from waiting import PATIENCE_S, wait_until


def stuck(file, room):
    """A stream whose thread waits for the reader with the first line."""
    stream = DroppingStream(file, room)
    print("line 0", file=stream)
    wait_until(lambda: not stream._pieces)
    return stream


@pytest.mark.parametrize("blocked", BLOCKED)
def test_a_writer_never_waits_and_memory_has_a_bound(blocked):
    with BLOCKED[blocked]() as number, open(number, "w", closefd=False) as file:
        stream = stuck(file, 10_000)
        for _ in range(5000):
            print("a line of forty characters, more or less", file=stream, flush=True)
        assert stream._bytes <= 10_000 + len(stream._pieces[-1]) and sum(map(len, stream._pieces)) <= 10_000
        assert stream._dropped > 4000
        assert not stream.offer("a status line")
        stream.end(0.01)
        print("after the end", file=stream, flush=True)


def test_a_line_of_any_length_and_a_text_of_many_lines_have_a_bound():
    most = 10_000 + len(CUT) + 1
    with BLOCKED["a pipe that nobody reads"]() as number, open(number, "w", closefd=False) as file:
        stream = stuck(file, 10_000)
        stream.write("x" * 1_000_000)  # a line without end
        stream.write("x" * 1_000_000)
        assert len(stream._begun) <= 10_000
        stream.write("y" * 1_000_000 + "\n")
        assert sum(map(len, stream._pieces)) <= most and not stream._begun
        stream.write("a line\n" * 100_000)
        assert sum(map(len, stream._pieces)) <= 10_000 and stream._dropped > 90_000
        stream.write("z" * 1_000_000)
        stream.flush()
        assert sum(map(len, stream._pieces)) <= most
        stream.end(0.01)


def test_a_line_that_is_cut_says_so_and_the_next_is_whole():
    reading, writing = os.pipe()
    with open(reading, "rb") as there:
        with open(writing, "w", encoding="utf-8") as file:
            stream = DroppingStream(file, 100)
            stream.write("a" * 70)
            stream.write("\u20ac" * 70)  # three bytes each: ten of them have room
            stream.write("b\n")
            first = ("a" * 70 + "\u20ac" * 10 + CUT + "\n").encode()
            assert there.read(len(first)) == first
            stream.write("the next\n")
            stream.end()
        assert there.read() == b"the next\n"


def test_a_terminal_that_comes_back_is_told_what_it_has_missed():
    with terminal() as (master, slave), open(slave, "w", closefd=False) as file:
        stop(slave)
        stream = stuck(file, 1000)
        for i in range(1, 500):
            print(f"line {i}", file=stream)
        stream.flush()
        dropped = stream._dropped
        go_on(slave)
        seen_lines = read_until(master, b"line 499\n").splitlines()
        at = seen_lines.index(f"punctura: {dropped} lines left out here: nobody read in time")
        shown = [f"line {i}" for i in (*range(at), *range(at + dropped, 500))]
        assert seen_lines[:at] + seen_lines[at + 1 :] == shown and at == 1 and dropped > 100
        print("and on", file=stream)
        assert read_until(master, b"and on\n") == "and on\n"
        wait_until(lambda: stream.offer("status"))  # what was read may not be counted as written yet
        assert read_until(master, b"status") == "status"
        stream.end()


def test_lines_stay_whole_and_a_flush_hands_on_what_has_begun():
    raw = io.BytesIO()
    text = io.TextIOWrapper(raw, "utf-8")
    stream = DroppingStream(text)
    stream.write("one ")
    stream.write("two\nthr")
    stream.flush()
    stream.write("ee \u20ac")
    stream.end()
    assert raw.getvalue().decode() == "one two\nthree \u20ac"
    with pytest.raises(TypeError):
        stream.write(b"bytes")


def test_a_reader_that_has_gone_is_no_error():
    reading, writing = os.pipe()
    with open(writing, "w") as file:
        os.close(reading)
        stream = DroppingStream(file)
        for _ in range(100):
            print("a line", file=stream, flush=True)
        stream.end()
        assert not stream.offer("a status line")


AT_THE_END = """
import atexit, os, sys
from punctura.live import DroppingStream
atexit.register(lambda: os.write(2, b"from somebody else"))  # called last
sys.stderr = DroppingStream(sys.stderr)
for _ in range(20_000):
    print("a line", file=sys.stderr)
sys.stderr.write("half a line")
sys.exit(7)
"""


@pytest.mark.parametrize("blocked", BLOCKED)
def test_a_program_ends_with_its_status_whoever_does_not_read(blocked):
    with BLOCKED[blocked]() as stderr:
        assert subprocess.run([sys.executable, "-c", AT_THE_END], stderr=stderr, timeout=PATIENCE_S).returncode == 7
    done = subprocess.run([sys.executable, "-c", AT_THE_END], capture_output=True, text=True, timeout=PATIENCE_S)
    assert done.returncode == 7 and done.stderr.endswith("a line\nhalf a linefrom somebody else")


# In a session of its own: on a terminal that suspends who writes in the background (stty tostop), and a job there.
BACKGROUND = """
import fcntl, os, subprocess, sys, termios
fcntl.ioctl(2, termios.TIOCSCTTY, 0)
modes = termios.tcgetattr(2)
modes[3] |= termios.TOSTOP
termios.tcsetattr(2, termios.TCSANOW, modes)
process = subprocess.Popen([sys.executable, "-c", sys.argv[1]], preexec_fn=os.setpgrp)
_, status = os.waitpid(process.pid, os.WUNTRACED)
print("suspended" if os.WIFSTOPPED(status) else os.waitstatus_to_exitcode(status))
process.kill()
"""
JOB = """
import sys
from punctura.live import DroppingStream
print("from the background", file=DroppingStream(sys.stderr))
"""


def test_a_program_in_the_background_is_not_suspended_by_what_it_writes():
    with terminal() as (master, slave):
        command = [sys.executable, "-c", BACKGROUND, JOB]
        done = subprocess.run(
            command, stdout=subprocess.PIPE, stderr=slave, text=True, start_new_session=True, timeout=PATIENCE_S
        )
        assert (done.returncode, done.stdout) == (0, "0\n")
        assert read_until(master, b"\n") == "from the background\n"


# A command with a defect, whose traceback is printed.
DEFECT = """
import punctura.cli._app as app
from punctura.cli._streams import never_wait_for_stderr
def command(*_, **__):
    never_wait_for_stderr()
    raise RuntimeError("a defect")
app.build_app = lambda *_: command
app.main()
"""


@pytest.mark.parametrize("blocked", BLOCKED)
def test_a_command_with_a_defect_ends_whoever_does_not_read_its_traceback(blocked, monkeypatch):
    monkeypatch.setenv("PUNCTURA_DEBUG", "1")
    with BLOCKED[blocked]() as stderr:
        assert subprocess.run([sys.executable, "-c", DEFECT], stderr=stderr, timeout=PATIENCE_S).returncode == 70
    done = subprocess.run([sys.executable, "-c", DEFECT], capture_output=True, text=True, timeout=PATIENCE_S)
    assert done.returncode == 70 and "\nRuntimeError: a defect\npunctura: a defect, please report it" in done.stderr
