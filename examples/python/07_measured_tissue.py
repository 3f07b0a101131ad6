"""A wall of measured tissue: a grip that grows faster than linearly, a tail, cutting, and a hole that stays."""

import numpy as np
import punctura as pn

needle = pn.Needle(diameter=1.27e-3, tip_angle=0.3)
wall = pn.Membrane(stiffness=400, precompression=0.1, friction=0.2, thickness=0.5e-3)
tissue = pn.Tissue(  # Tissue() is K06
    grip="exponential",
    growth=900,  # 1/m: G = c + kappa (exp(growth y) - 1) / growth
    tail_length=0.6e-3,  # m: behind the tip the shaft's friction falls ...
    tail_floor=0.7,  # ... to this part
    cutting=0.3,  # N: only while the tip goes where it has not been
    set=0.2,  # the part of the grip that a hole has lost
)

proxy = pn.Proxy1d(pn.TissueLaw(needle, wall, tissue), pn.Coupling(4000, 1), period=1 / 1600)
depth = 4e-3 - 5e-3 * np.cos(np.arange(6401) * np.pi / 3200)  # in and out
for insertion in (1, 2):
    force = proxy.run(depth).force
    for k in range(0, 6401, 400):
        print(f"depth {depth[k] * 1e3:6.2f} mm   force {force[k]:7.4f} N")
    work = -np.sum(force[1:3201] * np.diff(depth[:3201]))
    print(f"insertion {insertion} took {work * 1e3:.3f} mJ")
