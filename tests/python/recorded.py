"""A recording of a simulated device that ends by itself, made as fast as possible."""

import time

from punctura._core import ServoLoop
from punctura.record import Recorder


def recorded(path, device, scene, ticks):
    """Every tick of an armed loop, in `path`."""
    loop = ServoLoop(device, scene)
    with Recorder(loop, path, ticks):
        loop.arm()
        loop.start()
        deadline = time.monotonic() + 120
        while not device.finished:
            assert time.monotonic() < deadline, "waited in vain"
            time.sleep(1e-3)
        loop.stop()
    return path
