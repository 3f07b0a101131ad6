"""SI units of the core as products of base units, for a model description."""

from __future__ import annotations

import re
from collections import Counter

_UNITS: dict[str, dict[str, int]] = {
    "m": {"m": 1},
    "s": {"s": 1},
    "kg": {"kg": 1},
    "rad": {"rad": 1},
    "Hz": {"s": -1},
    "N": {"kg": 1, "m": 1, "s": -2},
    "Pa": {"kg": 1, "m": -1, "s": -2},
}


def base_units(unit: str) -> dict[str, int]:
    """The exponents of the base units: `N s/m` is kg 1, s -1. Raises ValueError for an unknown unit."""
    above, _, below = unit.partition("/")
    exponents: Counter[str] = Counter()
    for part, sign in ((above, 1), (below, -1)):
        for factor in part.split():
            match = re.fullmatch(r"([A-Za-z]+)(?:\^(\d+))?", factor)
            if factor == "1":
                continue
            if match is None or match[1] not in _UNITS:
                raise ValueError(f"unit {unit!r}: {factor!r} is unknown")
            for base, exponent in _UNITS[match[1]].items():
                exponents[base] += sign * exponent * int(match[2] or 1)
    return {base: exponent for base, exponent in exponents.items() if exponent}
