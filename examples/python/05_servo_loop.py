"""A servo loop in ten lines: a scene on a device, with ticks on the device's thread and all safety limits on."""

import time

import punctura as pn
from punctura.live import ServoLoop, SimulatedDevice
from punctura.simulation import Strokes

# For hardware use open_device("openhaptics") from punctura.live
device = SimulatedDevice(Strokes(start=[0, 5e-3, 0], end=[0, -10e-3, 0]), seed=1)
loop = ServoLoop(device, pn.load_scene("k06-fig10"))
loop.start()
loop.arm()  # the force ramps up over half a second as soon as the tip is outside tissue
while loop.report()["ticks"] < 4000:
    time.sleep(0.25)
    now = loop.latest()
    print(f"y {now.tip[0, 1] * 1e3:6.2f} mm   force {now.force[0, 1]:6.3f} N")
loop.stop()  # sets zero force, then ends the ticks
