import time

import punctura as pn
import pytest
from punctura.live import ServoLoop, SimulatedDevice
from punctura.record import Recorder
from punctura.simulation import Strokes


@pytest.fixture(scope="session")
def recording(tmp_path_factory):
    """1,000 ticks of two membranes."""
    path = tmp_path_factory.mktemp("ticks") / "run.parquet"
    device = SimulatedDevice(Strokes((0, 5e-3, 0), (0, -0.02, 0)), real_time=False, ticks=1000)
    loop = ServoLoop(device, pn.load_scene("k06-fig12"))
    recorder = Recorder(loop, path, 1000)
    loop.start()
    while not device.finished:
        time.sleep(1e-3)
    loop.stop()
    recorder.finish()
    return path
