"""The schema of plan files (docs/study.md), their reader and its checks.

Values are in SI units, because their paths are those of a scene.
"""

import difflib
import math
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from pydantic import Field

from punctura._core import Hand, Plant, Scene, Strokes, batch_paths
from punctura.batches.result import result_names
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.fields import Number, Numbers, Text, WholeNumber
from punctura.files.tables import Schema, Table
from punctura.files.toml import Tables, read_tables
from punctura.live import stroke_ends
from punctura.scene import load_scene, scene_names

Distribution = Literal["uniform", "normal", "lognormal"]


class MotionTable(Table):
    """Strokes of a simulated hand through all membranes and back."""

    count: WholeNumber = 1
    duration_s: Number | None = None  # of one way
    rest_s: Number | None = None
    variation: Number | None = None


class VariableTable(Table):
    """One number that differs between the trials."""

    path: Text
    values: Numbers | None = None  # of a grid
    distribution: Distribution = "uniform"
    low: Number | None = None
    high: Number | None = None
    mean: Number | None = None  # of a normal distribution
    sd: Number | None = None
    median: Number | None = None  # of a lognormal distribution
    sigma: Number | None = None  # standard deviation of the logarithm


class PlanFile(Table):
    """A study: a scene, a motion, and the numbers that differ."""

    scene: Text
    method: Literal["grid", "latin_hypercube", "sobol", "monte_carlo"]
    samples: WholeNumber | None = None
    seed: WholeNumber = 0
    duration_s: Number | None = None
    chunk: WholeNumber = 1000
    results: list[Text] | None = None
    values: dict[str, Number] = Field(default_factory=dict)
    motion: MotionTable = MotionTable()
    variable: list[VariableTable]


SCHEMA = Schema(PlanFile, {"values": PlanFile, "motion": MotionTable}, {"variable": VariableTable})


MOST_TRIALS = 100_000_000
_NEEDED = {"uniform": ("low", "high"), "normal": ("mean", "sd"), "lognormal": ("median", "sigma")}
_OWNERS = ("hand", "plant", "strokes")  # of numbers that are not the scene's


@dataclass(frozen=True)
class Plan:
    """A checked plan: what is the same in all trials, and the variables."""

    path: Path  # of its file
    file: PlanFile  # what the file says
    scene: Scene  # with the plan's values
    motion: Strokes  # of the hand
    plant: Plant  # the simulated device
    hand: Hand  # the simulated hand
    results: tuple[str, ...]  # columns of the table

    @property
    def duration(self) -> float | None:
        """Of each trial, s; None: as long as its strokes."""
        return None if self.file.duration_s is None else float(self.file.duration_s)

    @property
    def variables(self) -> list[VariableTable]:
        """The numbers that differ between the trials."""
        return self.file.variable


def load_plan(path: str | os.PathLike[str]) -> Plan:
    """Loads a plan file. Raises ConfigurationError with all problems."""
    path = Path(path)
    tables = read_tables(path, "plan")
    file, problems = SCHEMA.checked(tables)
    scene, found = scene_of(tables, path)
    problems += found
    if file is not None:
        problems += _numbers(file)
        problems += [p for i, one in enumerate(file.variable) for p in _variable(i, one, file.method)]
        problems += _names(file, scene)
        problems += _ticks(file, scene)
    if problems or file is None or scene is None:
        raise ConfigurationError(problems, str(path))
    return _built(path, file, scene)


def scene_of(tables: Tables, path: Path) -> tuple[Scene | None, list[Problem]]:
    """The scene that a file names: a ready one, or a file beside it. None without a name or with problems."""
    given = tables.get("scene")
    if not isinstance(given, str):
        return None, []
    try:
        return load_scene(given if given in scene_names() else str(path.parent / given)), []
    except ConfigurationError as bad:
        return None, [Problem("scene", given, "; ".join(str(p) for p in bad.problems))]


def _numbers(file: PlanFile) -> Iterator[Problem]:
    if file.method == "grid":
        if file.samples is not None:
            yield Problem("samples", file.samples, "a grid has as many trials as combinations of values; leave it out")
    elif file.samples is None:
        yield Problem("samples", MISSING, "is missing; a grid alone does without")
    elif not 1 <= file.samples <= MOST_TRIALS:
        yield Problem("samples", file.samples, f"must be from 1 to {MOST_TRIALS}")
    elif file.method == "sobol" and (file.samples < 2 or file.samples & (file.samples - 1)):
        yield Problem("samples", file.samples, "must be a power of 2, at least 2, for the method sobol")
    if file.chunk < 1:
        yield Problem("chunk", file.chunk, "must be 1 or more")
    if not 0 <= file.seed < 2**63:
        yield Problem("seed", file.seed, "must be from 0 to 2^63 - 1")
    if not 1 <= file.motion.count <= 1000:
        yield Problem("motion.count", file.motion.count, "must be from 1 to 1000")
    if file.duration_s is not None and not 0 < float(file.duration_s) <= 3600:
        yield Problem("duration_s", float(file.duration_s), "must be more than 0 and at most 3600 s")
    if not file.variable:
        yield Problem("variable", MISSING, "give at least one; begin each with [[variable]]")


def _ticks(file: PlanFile, scene: Scene | None) -> Iterator[Problem]:
    """A problem if the trials are shorter than a tick."""
    if scene is None or file.duration_s is None or not 0 < float(file.duration_s) <= 3600:
        return
    if round(float(file.duration_s) * scene.servo.rate) < 1:
        least = f"{1 / scene.servo.rate:.3g} s at the scene's {scene.servo.rate:g} Hz"
        yield Problem("duration_s", float(file.duration_s), f"is shorter than a tick: it must be at least {least}")


def _variable(i: int, one: VariableTable, method: str) -> Iterator[Problem]:
    at = f"variable[{i}]"
    if method == "grid":
        if not one.values:
            yield Problem(f"{at}.values", MISSING, "is missing; a grid needs the values, as [0.1, 0.2]")
        for k, value in enumerate(one.values or ()):
            if not _is_finite(value):
                yield Problem(f"{at}.values[{k}]", float(value), "must be a finite number")
        return
    if one.values is not None:
        yield Problem(f"{at}.values", MISSING, f"is for the method grid; give a distribution for {method}")
    for key in _NEEDED[one.distribution]:
        if getattr(one, key) is None:
            yield Problem(f"{at}.{key}", MISSING, f"is missing; a {one.distribution} distribution needs it")
    for key in ("mean", "sd", "median", "sigma"):
        if getattr(one, key) is not None and key not in _NEEDED[one.distribution]:
            yield Problem(f"{at}.{key}", float(getattr(one, key)), f"is not for a {one.distribution} distribution")
    not_finite = [k for k in ("low", "high", "mean", "sd", "median", "sigma") if not _is_finite(getattr(one, k))]
    for key in not_finite:  # a Decimal that is no number compares with nothing
        yield Problem(f"{at}.{key}", float(getattr(one, key)), "must be a finite number")
    if not_finite:
        return
    for key in ("sd", "median", "sigma"):
        if getattr(one, key) is not None and not getattr(one, key) > 0:
            yield Problem(f"{at}.{key}", float(getattr(one, key)), "must be greater than 0")
    if one.low is not None and one.high is not None and not one.low < one.high:
        yield Problem(f"{at}.low", float(one.low), f"must be less than high, which is {one.high}")


def _is_finite(value: object) -> bool:
    return value is None or math.isfinite(float(str(value)))


def nearest(path: str, known: Sequence[str]) -> str:
    """A known path that is similar, as the end of a reason; empty if there is none."""
    near = difflib.get_close_matches(path, known, 1, 0.5)
    return f"; did you mean {near[0]}?" if near else ""


def _names(file: PlanFile, scene: Scene | None) -> Iterator[Problem]:
    if scene is None:
        return
    known = batch_paths(scene)
    seen: set[str] = set()
    for at, path in [(f"variable[{i}].path", one.path) for i, one in enumerate(file.variable)]:
        if path not in known:
            near = nearest(path, known)
            reason = "is not a number of the scene, the hand, the plant or the strokes"
            yield Problem(at, path, f"{reason}{near} (docs/study.md)")
        if path in seen:
            yield Problem(at, path, "is given twice; give each path once")
        seen.add(path)
    for path in file.values:
        if path in seen:
            yield Problem(f"values.{path}", path, "is also the path of a variable; give it in one of them")
        if path not in known or path.startswith("strokes."):
            near = nearest(path, [one for one in known if not one.startswith("strokes.")])
            yield Problem(
                f"values.{path}", path, f"is not a number of the scene, the hand or the plant{near} (docs/study.md)"
            )
    names = result_names(len(scene.membranes))
    if file.results is not None and not file.results:
        yield Problem("results", MISSING, "is an empty list; name some, or leave it out for all")
    for i, name in enumerate(file.results or ()):
        if name not in names:
            yield Problem(f"results[{i}]", name, _unknown_result(name, names))


def _unknown_result(name: str, names: Sequence[str]) -> str:
    of_membranes = [one for one in names if one.startswith(f"{name}[")]
    if of_membranes:
        return f"is a result of each membrane: give {' or '.join(of_membranes)}"
    return f"is no result; known here: {', '.join(names)}"


def _built(path: Path, file: PlanFile, scene: Scene) -> Plan:
    def given(owner: str) -> dict[str, float]:
        head = f"{owner}."
        return {key.removeprefix(head): float(v) for key, v in file.values.items() if key.startswith(head)}

    own = {key: float(v) for key, v in file.values.items() if key.split(".")[0] not in _OWNERS}
    start, end = stroke_ends(scene)
    motion = file.motion
    extra = {"duration": motion.duration_s, "rest": motion.rest_s, "variation": motion.variation}
    strokes = {key: float(value) for key, value in extra.items() if value is not None}
    try:
        return Plan(
            path, file, scene.with_values(own), Strokes(start, end, count=motion.count, **strokes),
            Plant().replace(**given("plant")), Hand().replace(**given("hand")),
            tuple(dict.fromkeys(file.results or result_names(len(scene.membranes)))),
        )  # fmt: skip
    except ConfigurationError as bad:
        raise ConfigurationError(bad.problems, str(path)) from None
