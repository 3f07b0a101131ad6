"""A law maps each depth to a band of friction: inside it the needle sticks, on its edges it slides in or out."""

import numpy as np
import punctura as pn

needle = pn.Needle(diameter=1.08e-3, tip_angle=0.28)
wall = pn.Membrane(stiffness=570, precompression=0.41, friction=0.2, thickness=1e-3)
law = pn.ThickLaw(needle, wall)

# The pop: the whole tip is behind the wall.
print(f"tip {law.X * 1e3:.2f} mm   pop at {(law.X + law.U) * 1e3:.2f} mm   dry friction behind it {law.F:.3f} N")
depth = np.linspace(0, 8e-3, 401)
lower, upper = law.bounds(depth)
for q, slides_in, slides_out in zip(depth[::25], lower[::25], upper[::25], strict=True):
    print(f"depth {q * 1e3:5.2f} mm   slides in at {slides_in:7.4f} N   out at {slides_out:7.4f} N")
