"""A recording of a simulated device that ends by itself, made as fast as possible."""

import numpy as np
import pyarrow as pa
from punctura._core import ServoLoop
from punctura.record import Recorder
from waiting import wait_until


def run_to_end(loop):
    """Arms and starts the loop, and stops it after its device has ended by itself."""
    loop.arm()
    loop.start()
    wait_until(lambda: loop.device.finished)
    loop.stop()


def recorded(path, device, scene, ticks):
    """Records all ticks of an armed loop to `path`."""
    loop = ServoLoop(device, scene)
    with Recorder(loop, path, ticks) as recorder:
        assert recorder._listener.capacity >= ticks, "nothing slows this device down: the ring must hold all its ticks"
        run_to_end(loop)
    return path


def assert_same_table(one, other):
    """The tables have the same columns with the same values; NaN, as in a scene without a syringe, equals NaN."""
    assert one.schema.equals(other.schema)
    for name in one.schema.names:
        ours, theirs = one[name], other[name]
        if pa.types.is_floating(ours.type):
            np.testing.assert_array_equal(ours.to_numpy(), theirs.to_numpy(), err_msg=name)
        else:
            assert ours.to_pylist() == theirs.to_pylist(), name
