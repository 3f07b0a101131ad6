"""An object whose run() is at work gives no half-made values to another thread or to its progress function."""

import copy
import subprocess
import sys
import sysconfig
import threading
import time

import numpy as np
import punctura as pn
import pytest
from punctura.batches import LineBatch
from punctura.live import FedDevice
from punctura.simulation import Experiment, Target
from waiting import PATIENCE_S

SCENE = pn.load_scene("k06-fig12")
NEEDLE, MEMBRANE = SCENE.needle, SCENE.membranes[0].membrane
TARGET = Target((0, 0, 0))


def insertion():
    made = pn.Insertion(SCENE)
    return made, lambda progress: made.run(np.zeros((50, 3)), (0, -1, 0), progress=progress)


def line():
    made = pn.Proxy1d(pn.ThinLaw(NEEDLE, MEMBRANE), SCENE.coupling, 1e-3)
    return made, lambda progress: made.run(np.zeros(50), progress=progress)


def space():
    made = pn.Proxy3d(NEEDLE, MEMBRANE, (0, 0, 0), (0, -1, 0), SCENE.coupling, 1e-3)
    return made, lambda progress: made.run(np.zeros((50, 3)), (0, -1, 0), progress=progress)


def experiment():
    made = Experiment(SCENE, TARGET)
    return made, lambda progress: made.run(0.05, progress=progress)


def batch():
    made = LineBatch(pn.ThinLaw(NEEDLE, MEMBRANE), SCENE.coupling, 1e-3)
    return made, lambda progress: made.run(np.zeros(1000), progress=progress)


CASES = [
    (batch, "state"),
    (insertion, "depths phases tip force state"),
    (line, "force offset position depth phase state"),
    (space, "force offset position direction axial_force depth bounds phase state"),
    (experiment, "ticks state"),
]


@pytest.mark.parametrize("make, names", CASES)
def test_another_thread_reads_nothing_while_run_is_at_work(make, names):
    made, run = make()
    inside, may_go_on, read = threading.Event(), threading.Event(), []

    def progress(share):
        read.append([getattr(made, name) for name in names.split()[:-1]])  # this thread may
        inside.set()
        assert may_go_on.wait(PATIENCE_S)

    thread = threading.Thread(target=run, args=(progress,))
    thread.start()
    try:
        assert inside.wait(PATIENCE_S)
        for name in names.split():
            with pytest.raises(RuntimeError, match="at work on this object in another thread"):
                getattr(made, name)
        with pytest.raises(RuntimeError, match="give each thread a copy of its own"):
            copy.copy(made)
        assert repr(made) == f"<{type(made).__name__}, at work in another thread>"
    finally:
        may_go_on.set()
        thread.join()
    assert all(getattr(made, name) is not None for name in names.split()) and read


@pytest.mark.parametrize("make", [case[0] for case in CASES])
def test_a_progress_function_that_uses_its_own_object_is_told_so(make):
    made, run = make()
    named = []

    def progress(share):
        for use in (copy.copy, lambda _: run(None)):
            with pytest.raises(RuntimeError, match="a progress function or a signal handler that it called") as error:
                use(made)
            named.append("thread" in str(error.value))

    run(progress)
    assert named and not any(named)


def test_a_repr_hides_no_other_error():
    class Broken(FedDevice):
        @property
        def info(self):
            raise RuntimeError("the info is broken")

    with pytest.raises(RuntimeError, match="the info is broken"):
        repr(Broken(500))


WITHOUT_GIL = bool(sysconfig.get_config_var("Py_GIL_DISABLED"))


@pytest.mark.skipif(not WITHOUT_GIL, reason="this Python has a GIL")
def test_a_python_without_gil_stays_without():
    code = "import sys, punctura, punctura.live, punctura.batches; assert not sys._is_gil_enabled()"
    subprocess.run([sys.executable, "-W", "error", "-c", code], check=True)


def test_a_state_that_another_thread_takes_is_of_one_tick():
    proxy = insertion()[0]
    depths = np.linspace(-1e-3, 9e-3, 20_000)
    own = pn.Insertion(SCENE)
    right = {own.state}
    for depth in depths:
        own.step((0, -depth, 0), (0, -1, 0))
        right.add(own.state)
    taken, over = set(), threading.Event()

    def states():
        while not over.is_set():
            taken.add(proxy.state)

    readers = [threading.Thread(target=states) for _ in range(3)]
    for reader in readers:
        reader.start()
    try:
        for i, depth in enumerate(depths):
            proxy.step((0, -depth, 0), (0, -1, 0))
            if i % 100 == 0:
                time.sleep(0)  # lets a reader run, also on a busy computer
    finally:
        over.set()
        for reader in readers:
            reader.join()
    assert len(taken) > 1 and taken <= right and proxy.state == own.state
