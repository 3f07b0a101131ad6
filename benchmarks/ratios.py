"""The targets of the measurements."""

import math
from typing import Any, NamedTuple

# Targets for one tick of one membrane in one dimension.
MOST_OVER_FUSED = {"paper": 1.5, "exact": 2.5}
LEAST_UNDER_NUMPY = 300.0
# Target for one tick in a membrane of measured tissue with 8 knots, over K06's.
MOST_OVER_K06 = 2.0
# Target for the 99.9 % quantile of the wake-up latency.
MOST_OVER_CYCLICTEST = 1.3


class Ratio(NamedTuple):
    """A ratio of two times, with its quartiles and its target."""

    what: str
    value: float
    lower_quartile: float
    upper_quartile: float
    target: str
    passes: bool


def over_fused(rows: list[dict[str, Any]]) -> list[Ratio]:
    """Solver / reference loop, computed per round, because a disturbance slows both in the same round."""
    ratios = []
    for row in rows:
        if row["form"] != "1-D" or row["membranes"] != 1:
            continue
        for name, most in MOST_OVER_FUSED.items():
            spread = row["contestants"][name]["over_fused"]
            ratios.append(_at_most(most, f"{name} / fused, {row['scalar']}, {row['motion']} motion", spread))
    return ratios


def under_numpy(rows: list[dict[str, Any]], loops: dict[str, dict[str, float]]) -> list[Ratio]:
    """NumPy loop / solver in double. The quartiles are the extremes that both spreads allow."""
    numpy = loops["numpy"]
    row = next(r for r in rows if (r["form"], r["scalar"], r["membranes"]) == ("1-D", "double", 1))
    ratios = []
    for name in MOST_OVER_FUSED:
        ns = row["contestants"][name]
        value = numpy["median_ns"] / ns["median_ns"]
        low = numpy["lower_quartile_ns"] / ns["upper_quartile_ns"]
        high = numpy["upper_quartile_ns"] / ns["lower_quartile_ns"]
        target = f"at least {LEAST_UNDER_NUMPY:g}"
        ratios.append(Ratio(f"NumPy loop / {name}, double", value, low, high, target, value >= LEAST_UNDER_NUMPY))
    return ratios


def over_k06(rows: list[dict[str, Any]]) -> list[Ratio]:
    """A membrane of measured tissue / K06's membrane, with the same solver."""
    return [
        _at_most(MOST_OVER_K06, f"8 knots / K06, {row['solver']}, {row['form']}, {row['motion']}", row["over_k06"])
        for row in rows
    ]


def over_cyclictest(wakeups: dict[str, Any]) -> list[Ratio]:
    """Servo loop / cyclictest over all slices, with quartiles of neighbouring slices. Fails if not measured."""
    ratios = []
    for row in wakeups["conditions"]:
        over = row.get("over_cyclictest", dict.fromkeys(("pooled", "lower_quartile", "upper_quartile"), math.nan))
        what = f"servo loop / cyclictest, {row['name']}"
        ratios.append(_at_most(MOST_OVER_CYCLICTEST, what, over | {"median": over["pooled"]}))
    return ratios


def _at_most(most: float, what: str, spread: dict[str, float]) -> Ratio:
    value = spread["median"]
    target = f"at most {most:g}"
    return Ratio(what, value, spread["lower_quartile"], spread["upper_quartile"], target, value <= most)


def all_ratios(result: dict[str, Any]) -> list[Ratio]:
    """All ratios of tick times."""
    return over_fused(result["rows"]) + under_numpy(result["rows"], result["loops"]) + over_k06(result["tissue"])
