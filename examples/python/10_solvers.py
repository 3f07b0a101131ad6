"""Two solvers of the same equations: on a thin wall the paper's force alternates, and the exact one does not."""

import numpy as np
import punctura as pn

PERIOD = 1 / 1600  # s
law = pn.ThickLaw(pn.Needle(1.08e-3, 0.28), pn.Membrane(570, 0.41, 0.2, thickness=0.1e-3))
depth = np.arange(0, 1.5e-3, 20e-3 * PERIOD)  # 20 mm/s
forces = {}
for solver in ("paper", "exact"):
    forces[solver] = pn.Proxy1d(law, pn.Coupling(400, 1), PERIOD, solver=solver).run(depth).force

for q, paper, exact in zip(depth[:24], forces["paper"], forces["exact"], strict=False):
    print(f"depth {q * 1e3:6.3f} mm   paper {paper:7.4f} N   exact {exact:7.4f} N")
for solver, force in forces.items():
    turns = np.diff(np.sign(np.diff(force)))
    print(f"{solver}: the force turns back {np.count_nonzero(turns)} times")
