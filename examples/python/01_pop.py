"""One membrane in one dimension: depth in, force out. The 0.1 mm membrane of K06 section 4 at a constant 5 mm/s."""

import numpy as np
import punctura as pn

needle = pn.Needle(diameter=1.08e-3, tip_angle=0.28)
wall = pn.Membrane(stiffness=570, precompression=0.41, friction=0.2, thickness=0.1e-3)
proxy = pn.Proxy1d(pn.ThickLaw(needle, wall), pn.Coupling(stiffness=400, damping=1), period=1 / 1600)

depth = np.linspace(-1e-3, 9e-3, 3201)
ticks = proxy.run(depth)
for q, f in zip(depth[::160], ticks.force[::160], strict=True):
    print(f"depth {q * 1e3:6.2f} mm   force {f:7.4f} N")
