"""Builds the core's objects from one lane of random parameters."""

import punctura
from oracles.random_laws import Parameters


def needle(p: Parameters, lane: int) -> punctura.Needle:
    return punctura.Needle(float(p.diameter[lane]), float(p.tip_angle[lane]))


def membrane(p: Parameters, lane: int) -> punctura.Membrane:
    return punctura.Membrane(
        float(p.stiffness[lane]), float(p.precompression[lane]), float(p.friction[lane]), float(p.thickness[lane])
    )


def law(p: Parameters, lane: int) -> "punctura.ThinLaw | punctura.ThickLaw":
    """The thin law where the thickness is 0, else the thick one."""
    if p.thickness[lane] == 0:
        return punctura.ThinLaw(needle(p, lane), membrane(p, lane))
    return punctura.ThickLaw(needle(p, lane), membrane(p, lane), float(p.obliquity[lane]))
