"""A needle in space, at 40 degrees to the normal, through two membranes 3 mm apart."""

import numpy as np
import punctura as pn

wall = {"stiffness": 570, "precompression": 0.41, "friction": 0.2}
scene = pn.Scene(
    "two walls",
    pn.Needle(1.08e-3, 0.28),
    pn.Coupling(400, 1),
    [
        pn.PlacedMembrane("first", pn.Membrane(**wall, thickness=1.0e-3), [0, 0, 0], [0, -1, 0]),
        pn.PlacedMembrane("second", pn.Membrane(**wall, thickness=0.5e-3), [0, -4e-3, 0], [0, -1, 0]),
    ],
)

beta = np.deg2rad(40)
axis = np.array([np.sin(beta), -np.cos(beta), 0])
tip = np.array([0, 1e-3, 0]) + np.linspace(0, 20e-3, 4001)[:, None] * axis
trace = pn.Insertion(scene).run(tip, axis)

for p, f, phases in zip(tip[::200], trace.force[::200], trace.phase[::200], strict=True):
    names = ", ".join(pn.Phase(int(phase)).name for phase in phases)
    print(f"y {p[1] * 1e3:6.2f} mm   force {f[0]:6.3f} {f[1]:6.3f} N   {names}")
