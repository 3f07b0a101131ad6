"""The schema of plan files (docs/study.md). Values are in SI units, because their paths are those of a scene."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from punctura.files.fields import Number, Numbers, Text, WholeNumber
from punctura.files.tables import Schema, Table

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
