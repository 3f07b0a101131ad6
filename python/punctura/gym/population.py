"""Scenes that differ as people do: ranges over the numbers of a scene."""

from collections.abc import Mapping, Sequence
from numbers import Real
from typing import Literal, NamedTuple

import numpy as np

from punctura import Scene


class Vary(NamedTuple):
    """A number that is drawn once for each scene, evenly between `low` and `high`, and what it changes.

    paths: as in Scene.fields(), for example "membrane[0].stiffness". how: "scale" multiplies the scene's values by it,
    "shift" adds it (SI units), "set" replaces them. A mapping {path: weight} shifts each value by weight times the
    number, so that layers can move together.
    """

    paths: Sequence[str] | Mapping[str, float]
    low: float
    high: float
    how: Literal["scale", "shift", "set"] = "scale"


class Population:
    """Scenes around one scene. The same seed gives the same scene."""

    def __init__(self, scene: Scene, vary: Sequence[Vary] = ()) -> None:
        """Raises TypeError for an argument of another type, ValueError for an unknown path, range or word, and
        ConfigurationError if an end of a range is no scene."""
        if not isinstance(scene, Scene):
            raise TypeError(f"scene is {scene!r}, not a punctura.Scene, such as load_scene(...) returns")
        if not isinstance(vary, Sequence) or not all(isinstance(each, Vary) for each in vary):
            raise TypeError(f"vary must be a list of punctura.gym.Vary, not {vary!r}")
        self.scene = scene
        self.vary = tuple(vary)
        self._values = {field.path: field.value for field in scene.fields()}
        for each in self.vary:
            self._check(each)
        for share in (0.0, 1.0):
            self._at([share] * len(self.vary))

    def __repr__(self) -> str:
        return f"<Population around {self.scene.name!r}: {len(self.vary)} numbers vary>"

    def draw(self, random: np.random.Generator) -> Scene:
        """A scene of the population. Raises ConfigurationError if the drawn numbers together are no scene."""
        return self._at(random.random(len(self.vary)).tolist())

    def scene_of(self, seed: int) -> Scene:
        """The scene of a seed."""
        return self.draw(np.random.default_rng(seed))

    def _at(self, shares: Sequence[float]) -> Scene:
        changed: dict[str, float] = {}
        for each, share in zip(self.vary, shares, strict=True):
            number = each.low + share * (each.high - each.low)
            for path in each.paths:
                value = changed.get(path, self._values[path])
                weight = each.paths[path] if isinstance(each.paths, Mapping) else 1.0
                changed[path] = {"scale": value * number, "shift": value + weight * number, "set": number}[each.how]
        return self.scene.with_values(changed)

    def _check(self, each: Vary) -> None:
        if isinstance(each.paths, str):
            raise ValueError(f"paths must be a list of paths: [{each.paths!r}]")
        if not isinstance(each.paths, Sequence | Mapping):
            raise TypeError(f"paths must be a list of paths or a mapping of paths to weights, not {each.paths!r}")
        numbers = {"low": each.low, "high": each.high}
        if isinstance(each.paths, Mapping):
            numbers |= {f"the weight of {path!r}": weight for path, weight in each.paths.items()}
        for name, number in numbers.items():
            if isinstance(number, bool) or not isinstance(number, Real):
                raise TypeError(f"{list(each.paths)}: {name} must be a number, not {number!r}")
        unknown = [path for path in each.paths if path not in self._values]
        if unknown:
            raise ValueError(f"{unknown[0]!r} is not a number of scene {self.scene.name!r} (scene.fields() lists them)")
        if not (np.isfinite([each.low, each.high]).all() and each.low <= each.high):
            raise ValueError(f"{list(each.paths)}: low must be at most high, and both finite: {each.low}, {each.high}")
        if each.how not in ("scale", "shift", "set"):
            raise ValueError(f"how must be 'scale', 'shift' or 'set', not {each.how!r}")
        if isinstance(each.paths, Mapping) and each.how != "shift":
            raise ValueError("weights are for how='shift'")
