"""The whole tick on a simulated PHANTOM Omni in a simulated hand: input gate, conditioning, model, force limits."""

import punctura as pn
from punctura.simulation import Experiment, Strokes

scene = pn.Scene(
    "one wall",
    pn.Needle(1.08e-3, 0.28),
    pn.Coupling(400, 1),
    [pn.PlacedMembrane("wall", pn.Membrane(570, 0.41, 0.2, 0.1e-3), [0, 0, 0], [0, -1, 0])],
)
experiment = Experiment(scene, Strokes(start=[0, 5e-3, 0], end=[0, -10e-3, 0]), seed=1)
trace = experiment.run(experiment.duration)

if trace.fault_text:
    raise SystemExit(trace.fault_text)
for t, p, f in zip(trace.time[::800], trace.position[::800], trace.force[::800], strict=True):
    print(f"t {t:5.2f} s   y {p[1] * 1e3:6.2f} mm   force {f[1]:6.3f} N")
