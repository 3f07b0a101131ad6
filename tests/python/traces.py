"""Synthetic traces: what a sensor would record while the exact solver of the core is the tissue."""

import numpy as np
import punctura as pn
from punctura.trace import Trace

NEEDLE = pn.Needle(diameter=1.2e-3, tip_angle=0.4)
MEMBRANE = pn.Membrane(stiffness=600, precompression=0.3, friction=0.2, thickness=0.5e-3)
RATE = 200.0


def motion(deepest=15e-3, speed=5e-3, hold=1.0, times=1):
    """Depth (m) against time (s), from the start: in, a hold, out; `times` insertions."""
    going = np.arange(0, deepest, speed / RATE)
    once = np.concatenate((going, np.full(int(hold * RATE), deepest), going[::-1]))
    depth = np.tile(once, times)
    return np.arange(len(depth)) / RATE, depth


def force_of(depth, surface=5e-3, membrane=MEMBRANE, stiffness=4000.0):
    """The force that resists insertion (n,), N, of a membrane whose surface is at `surface` (m)."""
    proxy = pn.Proxy1d(pn.ThickLaw(NEEDLE, membrane), pn.Coupling(stiffness, 1.0), 1 / RATE)
    return -proxy.run(depth - surface).force


def trace(noise=5e-3, seed=1, surface=5e-3, **options):
    time, depth = motion(**options)
    return Trace(depth, force_of(depth, surface) + noise * np.random.default_rng(seed).normal(size=len(depth)), time)
