"""K06 on a trace, beside the rivals: as printed, and with the extensions that identification chooses."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from punctura._core import Experiment, Insertion, Needle, Scene
from punctura.identify import Identification, identify
from punctura.identify.criteria import Candidate
from punctura.identify.fit import Misfit
from punctura.identify.scene import scene_of
from punctura.rivals.chatter import DOWN, SERVO, Chatter, chatter
from punctura.trace import Trace

Array = NDArray[np.float64]
PRINTED = "k06"
CHOSEN = "k06_extended"


@dataclass(frozen=True)
class K06Fit:
    """K06 or its extended law fitted to a trace. SI."""

    name: str
    title: str
    parameters: int
    force: Array = field(repr=False)  # (n,), N, against the insertion
    residuals: Array = field(repr=False)  # (n,), N, measured less computed
    held_out_rmse: float  # N; NaN if it was not measured
    surface: float  # m, of the first membrane
    scene: Scene  # its membranes, without extensions


def fit_k06(trace: Trace, needle: Needle, known: Identification | None = None) -> tuple[K06Fit, ...]:
    """K06 as printed, and the extended law if identification chooses one. known: of this trace, if there is one.

    Needs SciPy. Raises TraceError.
    """
    found = known or identify(trace, needle)
    trace = found.trace  # without the noise of the depth
    chosen = found.candidates[0]
    printed = next(
        (one for one in found.candidates if one.model.late == chosen.model.late and not one.extensions), None
    )
    fits = [] if printed is None else [_fit(trace, PRINTED, "K06", printed)]
    if chosen.extensions:
        fits.append(_fit(trace, CHOSEN, f"K06 with {', '.join(chosen.extensions)}", chosen))
    return tuple(fits)


def _fit(trace: Trace, name: str, title: str, candidate: Candidate) -> K06Fit:
    parameters = candidate.fit.parameters
    force = Misfit(trace, parameters).with_depth_error(parameters).forces(parameters)
    held_out = float("nan") if candidate.held_out is None else candidate.held_out
    plain = scene_of(parameters, title)
    scene = Scene(plain.name, plain.needle, plain.coupling, plain.membranes, SERVO)
    surface = float(parameters.membranes[0, 0])
    return K06Fit(name, title, len(candidate.fit.u), force, trace.force - force, held_out, surface, scene)


def k06_chatter(scene: Scene, places: list[float]) -> Chatter:
    """The chatter of a scene's own law behind the line fit."""
    return chatter(
        lambda p: Insertion(scene).run(p, DOWN),
        lambda motion, duration: Experiment(scene, motion).run(duration),
        places,
    )
