"""Makes `from oracles import ...` work in every test, makes hypothesis draw the same cases every time, and keeps the
tests of a file, and of an xdist_group, in one worker, and keeps the log of defects out of the user's folders."""

import atexit
import os
import re
import shutil
import signal
import sys
import tempfile
from functools import cache
from pathlib import Path
from typing import NamedTuple

import pytest
from hypothesis import settings

sys.path.insert(0, str(Path(__file__).parent))
sys.path.append(str(Path(__file__).parents[2] / "tools"))  # waiting.py
sys.path.append(str(Path(__file__).parents[1] / "fakes"))  # inverse_service.py

from oracles import cases

# A shell starts its background jobs with SIGINT ignored. The tests of Ctrl-C then need Python's own handler.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

os.environ["XDG_STATE_HOME"] = tempfile.mkdtemp(prefix="punctura-state-")
atexit.register(shutil.rmtree, os.environ["XDG_STATE_HOME"], ignore_errors=True)

settings.register_profile("punctura", deadline=None, derandomize=True, database=None, max_examples=cases.count(200))
settings.load_profile("punctura")


class Done(NamedTuple):
    status: int
    stdout: str
    stderr: str


@pytest.fixture
def punctura(capsys):
    """The command line in this process: punctura(*arguments) returns its exit status and output."""
    from punctura.cli import main

    def call(*arguments):
        try:
            main([str(argument) for argument in arguments])
            status = 0
        except SystemExit as end:
            status = end.code or 0
        return Done(status, *capsys.readouterr())

    return call


@pytest.fixture
def free_umask():
    """New files are open to everybody, unless a program sees to it."""
    before = os.umask(0)
    yield
    os.umask(before)


_ROOT = Path(__file__).parents[2]


@cache
def _group_of(file):
    """The xdist_group of a whole test file; empty if it has none."""
    found = re.search(
        r'^pytestmark = pytest.mark.xdist_group\("(\w+)"\)', (_ROOT / file).read_text("utf-8"), re.MULTILINE
    )
    return found[1] if found else ""


@pytest.hookimpl(optionalhook=True)  # without xdist, too: the wheel's tests
def pytest_xdist_make_scheduler(config, log):
    """With pytest 9.2, the option --dist loadgroup of xdist 3.8 ignores the groups."""
    from xdist.scheduler import LoadGroupScheduling

    class ByFile(LoadGroupScheduling):
        def _split_scope(self, nodeid):
            file = nodeid.split("::")[0]
            return _group_of(file) or file  # what a file's tests share is made once

    return ByFile(config, log)
