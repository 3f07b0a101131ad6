"""A recording of a simulated device that ends by itself, made as fast as possible."""

from punctura._core import ServoLoop
from punctura.record import Recorder
from waiting import wait_until


def run_to_end(loop):
    """Armed, started, and stopped once its device has ended by itself."""
    loop.arm()
    loop.start()
    wait_until(lambda: loop.device.finished)
    loop.stop()


def recorded(path, device, scene, ticks):
    """Every tick of an armed loop, in `path`."""
    loop = ServoLoop(device, scene)
    with Recorder(loop, path, ticks) as recorder:
        assert recorder._listener.capacity >= ticks, "nothing slows this device down: the ring must hold all its ticks"
        run_to_end(loop)
    return path
