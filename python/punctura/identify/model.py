"""The models that identification chooses among: K06 with extensions, and the number of its membranes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from punctura import Needle
from punctura.identify.parameters import COUPLING, MEMBRANE, Parameters, default_coupling, default_membrane, kind_of

OWN = ("surface", "stiffness", "precompression", "friction", "thickness")  # each membrane's own
SHARED = ("stiffness", "friction", "thickness")  # of all membranes of one tissue
ONE_TISSUE = "one tissue"


@dataclass(frozen=True)
class Extension:
    """An addition to K06 that all membranes share: its parameters with start values, and when it can be seen."""

    name: str
    start: dict[str, float]  # SI; a stiffness as a part of the coupling's
    weak: dict[str, float]  # a start that is nearly K06: a search from there cannot end with a larger error
    needs_hold: bool = False
    needs_withdrawal: bool = False
    needs_insertions: int = 1
    after: str = ""  # the extension that must be there

    def values(self, parameters: Parameters, weak: bool = False) -> dict[str, float]:
        """The start values where these parameters have none of their own. A branch takes its part of K."""
        spring = parameters.get("coupling_stiffness")
        values = {}
        for name, value in (self.start | (self.weak if weak else {})).items():
            if name.startswith("relaxation"):
                values[name] = value * spring if name.endswith("stiffness") else value
            elif parameters.get(name) in (0.0, 1.0):
                values[name] = value
        return values


def extensions(needle: Needle) -> tuple[Extension, ...]:
    """Every extension that identification tries, in this order."""
    w, tip = needle.diameter, needle.diameter / np.tan(needle.tip_angle)
    return (
        Extension("curved grip", {"tissue.growth": 1 / w, "tissue.tip_length": tip}, {"tissue.growth": 0.01 / w}),
        Extension("tip length", {"tissue.tip_length": 1.2 * tip}, {"tissue.tip_length": tip}),
        Extension(
            "tail", {"tissue.tail_length": 0.3 * tip, "tissue.tail_floor": 0.8}, {"tissue.tail_floor": 0.98}
        ),
        Extension(
            "relaxation", {"relaxation_1_stiffness": 0.4, "relaxation_1_time": 1.0},
            {"relaxation_1_stiffness": 0.02}, needs_hold=True,
        ),
        Extension(
            "second relaxation", {"relaxation_2_stiffness": 0.3, "relaxation_2_time": 10.0},
            {"relaxation_2_stiffness": 0.02}, needs_hold=True, after="relaxation",
        ),
        Extension("set", {"tissue.set": 0.1}, {"tissue.set": 0.005}, needs_withdrawal=True),
        Extension("cutting", {"tissue.cutting": 0.05}, {"tissue.cutting": 0.002}, needs_insertions=2),
    )  # fmt: skip


@dataclass(frozen=True)
class Model:
    """How many membranes, which extensions, whether all walls are of one tissue, and what of the sensor is fitted."""

    membranes: int
    extensions: tuple[Extension, ...] = ()
    one_tissue: bool = False
    rig: tuple[str, ...] = ()  # of ZERO, beside the offset
    late: tuple[str, ...] = ()  # lag, delay

    @property
    def words(self) -> tuple[str, ...]:
        """The names of the extensions."""
        return (*(e.name for e in self.extensions), *([ONE_TISSUE] if self.one_tissue else []))

    @property
    def names(self) -> tuple[str, ...]:
        """The free parameters."""
        own = [kind for kind in OWN if not (self.one_tissue and kind in SHARED)]
        names = [f"membrane[{i}].{kind}" for i in range(self.membranes) for kind in own]
        names += [f"tissue.{kind}" for kind in SHARED] if self.one_tissue else []
        names += ["coupling_stiffness", "offset", *self.rig, *self.late]
        return tuple(dict.fromkeys((*names, *(name for e in self.extensions for name in e.start))))

    def extended(self, extension: Extension) -> Model:
        """With one extension more."""
        return replace(self, extensions=(*self.extensions, extension))

    def without(self, extension: Extension) -> Model:
        """With one extension less, and without those that need it."""
        kept = [one for one in self.extensions if extension.name not in (one.name, one.after)]
        return replace(self, extensions=tuple(kept))

    def switched_off(self, parameters: Parameters) -> Parameters:
        """Parameters in which every extension that this model has not is off."""
        values = dict(zip(MEMBRANE, default_membrane(), strict=True))
        values |= dict(zip(COUPLING, default_coupling(0.0), strict=True))
        off = {
            name: float(values[kind_of(name)])
            for extension in extensions(parameters.needle) for name in extension.start if name not in self.names
        }  # fmt: skip
        return parameters.with_values(off)

    def start(self, parameters: Parameters, weak: bool = False) -> Parameters:
        """Parameters from which this model can start: its extensions are there, and what it shares is the median."""
        for extension in self.extensions:
            parameters = parameters.with_values(extension.values(parameters, weak))
        if not self.one_tissue:
            return parameters
        middle = {
            f"tissue.{kind}": float(np.median([parameters.get(f"membrane[{i}].{kind}") for i in range(self.membranes)]))
            for kind in SHARED
        }
        return parameters.with_values(middle)
