"""From a measured trace to a membrane: the numbers of the tissue with their 95 % intervals, and a scene to feel."""

import numpy as np
import punctura as pn
from punctura.identify import identify
from punctura.trace import Trace

# In place of a testing machine: 5 mm of air, a wall, 1 s of rest, and out; 10 mN of noise.
# A file of yours: punctura.trace.read_trace("file.csv")
needle = pn.Needle(diameter=1.2e-3, tip_angle=0.4)
truth = pn.Membrane(stiffness=600, precompression=0.3, friction=0.2, thickness=0.5e-3)
time = np.arange(0, 7, 0.01)
depth = np.interp(time, [0, 3, 4, 7], [0, 15e-3, 15e-3, 0])
force = -pn.Proxy1d(pn.ThickLaw(needle, truth), pn.Coupling(4000, 1), 0.01).run(depth - 5e-3).force
force += 0.01 * np.random.default_rng(1).standard_normal(len(time))

found = identify(Trace(depth, force, time), needle)
for estimate in found.estimates:
    print(f"{estimate.name:28} {estimate.value:9.4g}   {estimate.low:9.4g} to {estimate.high:9.4g} {estimate.unit}")
print(*found.verdicts, sep="\n")
