"""Arrays, lists and literals that a user may pass: mypy and pyright accept all of it when strict. Nobody runs this."""

from typing import Literal

import numpy as np
import numpy.typing as npt
import punctura as pn
from punctura.events import EventFinder
from punctura.live import DeviceInfo, FedDevice, ForceLimits, GateLimits, ServoLoop, SimulatedDevice, open_device
from punctura.record import Recorder, open_recording
from punctura.scene import ServoSettings
from punctura.simulation import Experiment, Hand, RecordedMotion, Strokes, Target

Floats = npt.NDArray[np.float64]
solvers: tuple[Literal["exact", "paper"], ...] = ("exact", "paper")

needle = pn.Needle(1.08e-3, 0.28)
membrane = pn.Membrane(stiffness=570, precompression=0.41, friction=0.2, thickness=1e-4)
thick = pn.ThickLaw(needle, membrane, obliquity=0.3)
lower, upper = thick.bounds(np.linspace(0, 5e-3, 11))
at_one: tuple[float, float] = thick.bounds(1e-3)
at_int: tuple[float, float] = thick.bounds(0)
shapes: Floats = thick.bounds([0.0, 1e-3])[0] + lower + upper

# Positions as tuple, list, array of any real type; runs take whatever NumPy can make an array of.
space = [
    pn.Proxy3d(needle, membrane, (0, 0, 0), np.array([0, -1, 0]), pn.Coupling(400, 1), 1 / 1600, s) for s in solvers
]
one: list[float] = space[0].step((0, 1e-3, 0), [0, -1, 0])
other: list[float] = space[1].peek(np.zeros(3, dtype=np.float32), np.array([0, -1, 0]))
path: pn.Ticks = space[0].run([[0, 1e-3, 0], [0.0, 0.0, 0.0]], (0, -1, 0))
forces: Floats = path.force
line: pn.Ticks = pn.Proxy1d(thick, pn.Coupling(400, 1), 1 / 1600).run([0.0, 1e-3])
worst: float = line.force.min()

scene = pn.Scene(
    "one wall",
    needle,
    pn.Coupling(400, 1),
    (pn.PlacedMembrane("wall", membrane, np.zeros(3), (0, -1, 0), behind="blood"),),
    ServoSettings(rate=1000, solver="paper", conditioning="line_fit", encoder_step=5e-5),
    direction="motion",
)
symbols: list[str] = [field.symbol for field in scene.fields() if field.max > field.min]
softer: pn.Scene = scene.with_values({"membrane[0].stiffness": 300}).replace(name="softer")
kept: bytes = pn.Insertion(scene).state

motions: list[Strokes | RecordedMotion | Target] = [
    Strokes(start=(0, 5e-3, 0), end=np.array([0, -1e-2, 0])),
    RecordedMotion(np.arange(3) / 1600, np.zeros((3, 3))),
    Target([0, 0, 0]),
]
for motion in motions:
    experiment = Experiment(softer, motion, hand=Hand(tremor_rms=0), seed=1, axis=np.array([0.0, -1.0, 0.0]))
    trace: pn.Ticks = experiment.run(1)
    pops: int = sum(event.what == "pop" for event in EventFinder(softer).add(trace))

fed = FedDevice(1000.0, info=DeviceInfo(model="own", has_orientation=True, max_force=3.0))
answer: tuple[float, float, float] = fed.feed((0.0, 0.05, 0.0))
for device in (fed, SimulatedDevice(Target((0, 0, 0))), open_device("simulated")):
    with ServoLoop(device, scene, limits=ForceLimits(max_force=1.0), gate=GateLimits()) as loop:
        listener = loop.listen()
        with Recorder(loop, "run.parquet"):
            loop.start()
        seen: pn.Ticks = listener.read()
rows: int = open_recording("run.parquet").rows
