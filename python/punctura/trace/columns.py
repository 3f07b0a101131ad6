"""Which column of a table is depth, force or time, and in which unit."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from punctura.trace.trace import TraceError

ROLES = ("depth", "force", "time")
REQUIRED = ("depth", "force")

# Size of a unit in SI units.
UNITS: dict[str, dict[str, float]] = {
    "depth": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "in": 0.0254},
    "force": {"N": 1.0, "mN": 1e-3, "kN": 1e3, "gf": 9.80665e-3, "kgf": 9.80665, "lbf": 4.4482216152605},
    "time": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "min": 60.0},
}
_NAMES = {
    "depth": {"depth", "displacement", "position", "extension", "travel", "insertion", "insertion_depth", "z", "x"},
    "force": {"force", "load", "axial_force", "needle_force", "insertion_force", "f", "fz"},
    "time": {"time", "t", "elapsed", "timestamp"},
}


def split_name(name: str) -> tuple[str, str]:
    """Splits a column's name into its plain name and its unit: `depth_mm`, `Depth (mm)`, `depth [mm]`, `Depth/mm`."""
    text = name.strip()
    found = re.fullmatch(r"(.+?)\s*[\[(]\s*([^\])]*)\s*[\])]", text) or re.fullmatch(r"(.+?)[\s_/]+([A-Za-zµ]+)", text)
    known = {unit for units in UNITS.values() for unit in units}
    if found and found[2].strip() in known:
        text, unit = found[1], found[2].strip()
    else:
        unit = ""
    return re.sub(r"[\s_-]+", "_", text.strip().lower()), unit


def choose_columns(names: Sequence[str], columns: Mapping[str, str | int] | None, source: str) -> dict[str, int]:
    """The index of the column for each role. Raises TraceError that lists the names if a role is unclear."""
    listed = ", ".join(repr(name) for name in names)
    chosen: dict[str, int] = {}
    for role, wanted in (columns or {}).items():
        if role not in ROLES:
            raise TraceError(f"{source}: {role!r} is no role of a column; the roles are {', '.join(ROLES)}")
        if isinstance(wanted, str) and wanted in names:
            chosen[role] = list(names).index(wanted)
        elif str(wanted).isdigit() and 1 <= int(wanted) <= len(names):
            chosen[role] = int(wanted) - 1
        else:
            raise TraceError(f"{source}: there is no column {wanted!r} for the {role}; the columns are {listed}")
    for role in ROLES:
        if role in chosen:
            continue
        matches = [
            i for i, name in enumerate(names) if split_name(name)[0] in _NAMES[role] and i not in chosen.values()
        ]
        exact = [i for i in matches if split_name(names[i])[0] == role]
        if len(exact) == 1 or len(matches) == 1:
            chosen[role] = (exact or matches)[0]
        elif matches or role in REQUIRED:
            problem = f"more than one column could be the {role}" if matches else f"no column is known to be the {role}"
            raise TraceError(f"{source}: {problem}; the columns are {listed}. Name one: --column {role}=NAME")
    return chosen


def unit_size(role: str, name: str, units: Mapping[str, str] | None, source: str) -> float:
    """The size of a column's unit in SI units, from `units` or from the column's name. Raises TraceError."""
    written = split_name(name)[1]
    unit = (units or {}).get(role, written)
    known = ", ".join(UNITS[role])
    if not unit:
        raise TraceError(
            f"{source}: the unit of the {role} column {name!r} is not stated: give --unit {role}=UNIT ({known})"
        )
    if unit not in UNITS[role]:
        raise TraceError(f"{source}: {unit!r} is no unit of the {role}; the units are {known}")
    return UNITS[role][unit]
