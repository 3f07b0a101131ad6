"""A program ends with its own status while daemon threads are in a run, and so does the child of a fork."""

import os
import subprocess
import sys

import pytest
from waiting import PATIENCE_S

SCENE = "import os, sys, threading, numpy as np, punctura as pn\nscene = pn.load_scene('k06-fig10')\n"
THREAD = """
class Slow:  # gives the thread time to ask for the lock while Python ends
    def __del__(self, sleep=__import__("time").sleep):
        sleep(0.5)
slow = Slow()
began = threading.Event()
def work():
    while True:
        RUN
threading.Thread(target=work, daemon=True).start()
began.wait()
"""


def ended(program):
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE_S)


@pytest.mark.parametrize(
    "run",
    [
        "pn.Insertion(scene).run(np.zeros((200_000, 3)), (0, -1, 0), progress=lambda share: began.set())",
        # Nearly all of the time in Python code that the run calls, or that makes its result.
        "pn.Insertion(scene).run(np.zeros((9, 3)), (0, -1, 0), progress=lambda _: began.set() or sum(range(10**6)))",
        "pn.Insertion(scene).run(np.zeros((1, 3)), (0, -1, 0)), began.set()",
        "pn.batch(scene, motion=np.zeros((2000, 3)), trials=64, progress=lambda share: began.set())",
    ],
)
def test_a_daemon_thread_in_a_run_does_not_abort_the_end(run):
    done = ended(SCENE + THREAD.replace("RUN", run))
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
def test_the_child_of_a_fork_ends_while_threads_of_the_parent_wait_for_the_lock():
    program = (
        # Since 3.12, Python warns of a fork with several threads.
        "import warnings\nwarnings.simplefilter('ignore', DeprecationWarning)\n"
        + SCENE
        + """
from punctura.live import Pacer
def wait():
    pacer = Pacer(20000.0)
    while True:
        pacer.wait()
def compute():
    while True:
        sum(range(1000))
for work in (wait, wait, wait, compute):
    threading.Thread(target=work, daemon=True).start()
for _ in range(5):
    child = os.fork()
    if child == 0:
        sys.exit(0)
    assert os.waitpid(child, 0)[1] == 0
"""
    )
    done = ended(program)
    assert (done.returncode, done.stderr) == (0, "")
