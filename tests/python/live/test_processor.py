"""The loop's thread runs on the requested CPU."""

import os
from pathlib import Path

import punctura as pn
import pytest
from punctura._core import ServoLoop, SimulatedDevice
from punctura.live import open_device, open_for
from punctura.simulation import Target
from waiting import wait_until

SCENE = pn.load_scene("k06-fig10")
LAST = sorted(os.sched_getaffinity(0))[-1]


def processors_of_threads():
    """The CPUs on which each thread of this process may run."""
    return [os.sched_getaffinity(int(task.name)) for task in Path("/proc/self/task").iterdir()]


@pytest.mark.parametrize("how", ["made", "opened", "chosen"])
def test_the_thread_that_ticks_stays_on_its_processor(how):
    device = {
        "made": lambda: SimulatedDevice(Target([0, 5e-3, 0]), processor=LAST),
        "opened": lambda: open_device("simulated", processor=LAST),
        "chosen": lambda: open_for(SCENE, "simulated", LAST),
    }[how]()
    loop = ServoLoop(device, SCENE)
    before = processors_of_threads()
    loop.start()
    try:
        wait_until(lambda: loop.latest()["tick"][0] > 0)
        after = processors_of_threads()
        assert after.count({LAST}) == before.count({LAST}) + 1
        assert f"processor {LAST}: granted" in device.statements()
    finally:
        loop.stop()


def test_one_that_does_not_exist_does_no_harm_and_is_said():
    device = SimulatedDevice(Target([0, 5e-3, 0]), ticks=16, processor=4095)
    loop = ServoLoop(device, SCENE)
    loop.start()
    wait_until(lambda: device.finished)
    loop.stop()
    assert any(text.startswith("processor 4095: not granted") for text in device.statements())


def test_the_command_line_refuses_one_that_is_not_there(punctura):
    done = punctura("run", "--headless", "--processor", "4095")
    assert done.status == 2
    assert f"processor 4095 cannot be used here; there are {', '.join(map(str, sorted(os.sched_getaffinity(0))))}" in (
        " ".join(done.stderr.replace("│", " ").split())
    )


def test_the_command_line_passes_it_on(punctura):
    done = punctura("run", "--headless", "--device", "simulated", "--duration", "0.2", "--processor", LAST)
    assert done.status == 0, done.stderr
    assert f"processor {LAST}: granted" in done.stdout
