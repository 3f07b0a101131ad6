"""The parameters of the experiments, read from the objects that ran."""

from __future__ import annotations

from typing import NamedTuple

from punctura._core import Hand, Plant
from punctura.reproduce.operator import COUNT, DURATION_S, REST_S, SEED, START_MM, STROKE_DEPTH_MM, VARIATION
from punctura.reproduce.scenes import k06_scene

_K06 = "K06 section 4"
_OMNI = "maker's data sheet"
_CHOICE = "chosen here"


class Parameter(NamedTuple):
    """A row of the page's table."""

    group: str
    name: str
    value: str
    source: str


def parameters() -> list[Parameter]:
    """The parameters of Figs. 5 and 10 to 12."""
    scene, plant, hand = k06_scene("k06-fig10"), Plant(), Hand()
    depths = " / ".join(f"{depth:g}" for depth in STROKE_DEPTH_MM.values()) + " mm"
    membrane = scene.membranes[0].membrane
    return [
        Parameter("needle", "diameter w", f"{scene.needle.diameter * 1e3:g} mm", _K06),
        Parameter("needle", "tip angle θ", f"{scene.needle.tip_angle:g} rad", _K06),
        Parameter("membrane", "stiffness κ", f"{membrane.stiffness * 1e-3:g} N/mm", _K06),
        Parameter("membrane", "precompression c", f"{membrane.precompression:g} N", _K06),
        Parameter("membrane", "friction μ", f"{membrane.friction:g}", _K06),
        Parameter("coupling", "stiffness K", f"{scene.coupling.stiffness * 1e-3:g} N/mm", _K06),
        Parameter("coupling", "damping B", f"{scene.coupling.damping * 1e-3:g} N s/mm", _K06),
        Parameter("servo loop", "rate 1/T", f"{scene.servo.rate:g} Hz", _K06),
        Parameter("servo loop", "low-pass on the position", f"{scene.servo.low_pass:g} Hz", _K06),
        Parameter("device", "apparent mass", f"{plant.mass * 1e3:g} g", _OMNI),
        Parameter("device", "dry friction", f"{plant.friction:g} N", _OMNI),
        Parameter("device", "encoder step", f"{plant.encoder_step * 1e3:g} mm", _OMNI),
        Parameter("device", "largest force", f"{plant.max_force:g} N", _OMNI),
        Parameter("hand", "mass", f"{hand.mass * 1e3:g} g", "illustrative"),
        Parameter("hand", "stiffness", f"{hand.stiffness * 1e-3:g} N/mm", "illustrative"),
        Parameter("hand", "damping", f"{hand.damping * 1e-3:g} N s/mm", "illustrative"),
        Parameter("hand", "tremor", f"{hand.tremor_rms * 1e3:g} mm rms at {hand.tremor_hz:g} Hz", "illustrative"),
        Parameter("strokes", "count, one way, rest", f"{COUNT}, {DURATION_S:g} s, {REST_S:g} s", _CHOICE),
        Parameter("strokes", "start, distance from the membrane", f"{START_MM:g} mm", _CHOICE),
        Parameter("strokes", "desired depth, Figs. 10 / 11 / 12", depths, _CHOICE),
        Parameter("strokes", "standard deviation of depth and time", f"{VARIATION * 100:g} %", _CHOICE),
        Parameter("strokes", "seed", f"{SEED}", _CHOICE),
    ]
