"""Where blood is: behind the one membrane whose table says so, up to the next one in the way."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from punctura._core import PlacedMembrane
from punctura.errors import Problem

BLOOD = "blood"


def next_behind(membranes: Sequence[PlacedMembrane], i: int) -> int | None:
    """The membrane that a needle meets next after membrane i, going straight in; None if there is no other."""
    here, inward = np.array(membranes[i].point), np.array(membranes[i].inward_normal)
    ways = [(float((np.array(m.point) - here) @ inward), j) for j, m in enumerate(membranes) if j != i]
    behind = [(way, j) for way, j in ways if way > 0]
    return min(behind)[1] if behind else None


def lumen(membranes: Sequence[PlacedMembrane], behind: Sequence[object]) -> tuple[int, int] | None:
    """The two membranes between which blood is, if any. behind: of each membrane, what its table says."""
    for i, what in enumerate(behind):
        if what == BLOOD and (j := next_behind(membranes, i)) is not None:
            return i, j
    return None


def lumen_problems(membranes: Sequence[PlacedMembrane], behind: Sequence[object]) -> list[Problem]:
    """At most one membrane may have blood behind it, and another must bound it."""
    blood = [i for i, what in enumerate(behind) if what == BLOOD and i < len(membranes)]
    problems = [
        Problem(f"membrane[{i}].behind", BLOOD, f"only one membrane may; membrane[{blood[0]}] has it already")
        for i in blood[1:]
    ]
    if blood and next_behind(membranes, blood[0]) is None:
        problems.insert(0, Problem(f"membrane[{blood[0]}].behind", BLOOD, "no other membrane bounds the blood behind"))
    return problems
