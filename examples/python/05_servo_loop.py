"""A servo loop in ten lines: a scene on a device, every tick on the device's own thread, with every safety limit on."""

import time

import punctura as pn
from punctura.live import ServoLoop, SimulatedDevice

# Hardware instead: open_device("openhaptics"), of punctura.live
device = SimulatedDevice(pn.Strokes(start=[0, 5e-3, 0], end=[0, -10e-3, 0]), seed=1)
loop = ServoLoop(device, pn.load_scene("k06-fig10"))
loop.start()
loop.arm()  # force comes once the tip is outside of tissue, over half a second
while loop.report()["ticks"] < 4000:
    time.sleep(0.25)
    now = loop.latest()
    print(f"y {now.tip[0, 1] * 1e3:6.2f} mm   force {now.force[0, 1]:6.3f} N")
loop.stop()  # zero force, then no tick any more
