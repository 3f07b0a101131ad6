"""A custom device in less than 80 lines: feed its readings, and apply the returned force.

This device is an imaginary pendulum. Its bob carries the needle and swings into the tissue. Replace read() and write()
by the calls of your driver. The tick is compiled and never waits for Python, but this program decides when it runs.
"""

import threading

import punctura as pn
from punctura.live import DeviceInfo, FedDevice, Pacer, make_realtime, run_live

RATE = 1000.0  # readings per second, Hz


class Pendulum:
    """Simulates the hardware. Punctura's axes: x right, y up, z towards the user; m, N."""

    mass, stiffness = 0.2, 2.0  # kg; N/m: a period of two seconds
    height, speed = 0.05, 0.0  # m above its lowest point, m/s

    def read(self) -> tuple[float, float, float]:
        return 0.0, self.height, 0.0

    def write(self, force: tuple[float, float, float]) -> None:
        """Applies the force and simulates one period."""
        self.speed += (force[1] - self.stiffness * self.height) / self.mass / RATE
        self.height += self.speed / RATE


class Driver(threading.Thread):
    """The device's clock: feeds a reading, applies the force. Always sets zero force at the end."""

    def __init__(self, hardware: Pendulum, device: FedDevice) -> None:
        super().__init__(daemon=True)
        self.hardware, self.device = hardware, device
        self.over = threading.Event()

    def run(self) -> None:
        self.device.make_realtime()  # without this, other programs can delay a tick by 20 ms, a fault
        pacer = Pacer(RATE)
        try:
            while not self.over.is_set():
                pacer.wait()
                self.hardware.write(self.device.feed(self.hardware.read()))
        finally:
            self.hardware.write((0.0, 0.0, 0.0))


hardware = Pendulum()
device = FedDevice(RATE, info=DeviceInfo(model="Pendulum, made up", has_orientation=True, max_force=3.0))
wall = pn.PlacedMembrane("wall", pn.Membrane(570, 0.41, 0.2, 1e-3), [0, 0.02, 0], [0, -1, 0])
scene = pn.Scene("one wall", pn.Needle(1.08e-3, 0.28), pn.Coupling(400, 1), [wall])

make_realtime(priority=10)  # this thread too, because the driver waits while another thread holds the GIL
driver = Driver(hardware, device)
driver.start()
try:
    summary = run_live(device, scene, duration=2)
finally:
    driver.over.set()
    driver.join()
print(f"{summary.ticks} ticks, {summary.late} late, strongest force {summary.felt_peak_N:.3f} N {summary.fault}")
print(*summary.statements, sep="\n")
