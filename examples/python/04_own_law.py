"""A friction law of your own: a profile of the band's edges, with straight lines between its knots."""

import punctura as pn

# A gel that grips the shaft in proportion to the length inside it, both ways, up to a bottom.
SLOPE, BOTTOM = 50, 30e-3  # N/m, m
gel = pn.ProfileLaw(depth=[0, BOTTOM], lower=[0, -SLOPE * BOTTOM], upper=[0, SLOPE * BOTTOM])

proxy = pn.Proxy1d(gel, pn.Coupling(stiffness=400, damping=1), period=1 / 1600)
for k in range(1601):
    depth = 20e-3 * (k if k < 800 else 1600 - k) / 800
    force = proxy.step(depth)
    if k % 100 == 0:
        print(f"depth {depth * 1e3:6.2f} mm   force {force:7.4f} N")
