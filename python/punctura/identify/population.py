"""The population of many traces: mean and spread of each parameter, and the values of a trace drawn to the mean."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from punctura.identify.records import ParameterRecord, PopulationRow

Array = NDArray[np.float64]


def population(rows: Sequence[ParameterRecord]) -> list[PopulationRow]:
    """One row a parameter: the mean over traces, the spread between traces, and how far single traces are to be drawn.

    rows: one for each trace and parameter. Only parameters with both bounds count. A parameter that is positive in all
    traces is described by its logarithm: mean is then the median of the population, and spread a factor minus 1. The
    95 % interval of the mean is Student's: the spread of a few traces is hardly known.
    """
    from scipy.special import stdtrit

    found: list[PopulationRow] = []
    for name in dict.fromkeys(row["name"] for row in rows):
        of_name = [row for row in rows if row["name"] == name]
        used = [
            (row["value"], low, high)
            for row in of_name
            if (low := row["low"]) is not None and (high := row["high"]) is not None and high > low
        ]
        if len(used) < 2:
            continue
        value, low, high = np.array(used, float).T
        positive = bool((low > 0).all())
        if positive:
            value, low, high = np.log(value), np.log(low), np.log(high)
        error = (high - low) / (2 * 1.96)
        mean, between, of_mean = random_effects(value, error)
        shrinkage = float(np.mean(error**2 / (error**2 + between**2)))
        back = np.exp if positive else np.asarray
        away = float(stdtrit(len(used) - 1, 0.975)) * of_mean
        found.append({
            "name": name, "unit": of_name[0]["unit"], "traces": len(used), "mean": float(back(mean)),
            "low": float(back(mean - away)), "high": float(back(mean + away)),
            "spread": float(np.expm1(between)) if positive else between, "spread_is_relative": positive,
            "shrinkage": shrinkage,
        })  # fmt: skip
    return found


def random_effects(value: Array, error: Array) -> tuple[float, float, float]:
    """Mean, spread between traces, and standard error of the mean, of values with known errors (n,).

    The spread makes the weighted sum of squares equal to its expectation (Paule and Mandel 1982).
    """
    variance = np.maximum(error, 1e-12 * max(1.0, float(np.abs(value).max()))) ** 2

    def excess(between: float) -> float:
        weight = 1 / (variance + between)
        mean = float(np.sum(weight * value) / np.sum(weight))
        return float(np.sum(weight * (value - mean) ** 2)) - (len(value) - 1)

    low, high = 0.0, float(np.var(value)) * 4 + float(variance.max())
    if excess(0.0) <= 0:
        high = 0.0
    for _ in range(80 if high else 0):
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) > 0 else (low, middle)
    weight = 1 / (variance + high)
    return float(np.sum(weight * value) / np.sum(weight)), float(np.sqrt(high)), float(1 / np.sqrt(np.sum(weight)))


def drawn_to_mean(value: Array, error: Array) -> Array:
    """The values of single traces (n,), each drawn to the population's mean as far as its own error asks for."""
    mean, between, _ = random_effects(value, error)
    share = error**2 / (error**2 + between**2) if between > 0 else np.ones_like(error)
    return np.asarray(value + share * (mean - value))
