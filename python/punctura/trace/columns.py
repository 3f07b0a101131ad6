"""Which column of a table is depth, force or time, and in which unit."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from typing import Literal

from punctura.trace.trace import TraceError

ROLES = ("depth", "force", "time")
REQUIRED = ("depth", "force")
_MOST_LISTED = 30  # columns in a message

# Size of a unit in SI units.
UNITS: dict[str, dict[str, float]] = {
    "depth": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "in": 0.0254},
    "force": {"N": 1.0, "mN": 1e-3, "kN": 1e3, "gf": 9.80665e-3, "kgf": 9.80665, "lbf": 4.4482216152605},
    "time": {"s": 1.0, "sec": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "min": 60.0},
}
# English and German, as programs of testing machines write them.
_NAMES = {
    "depth": {
        "depth", "displacement", "position", "extension", "travel", "stroke", "crosshead", "insertion", "penetration",
        "insertion_depth", "penetration_depth", "needle_depth", "compressive_extension", "compressive_displacement",
        "z", "x", "weg", "standardweg", "traversenweg", "tiefe", "eindringtiefe", "einstichtiefe",
    },
    "force": {
        "force", "load", "axial_force", "axial_load", "needle_force", "insertion_force", "compressive_force",
        "compressive_load", "standard_force", "f", "fz", "kraft", "standardkraft", "nadelkraft",
    },
    "time": {"time", "t", "elapsed", "elapsed_time", "test_time", "timestamp", "zeit", "prüfzeit", "testzeit"},
}  # fmt: skip


def known_unit(text: str) -> str:
    """The unit in a cell of its own, `mm`, `(mm)` or `[mm]`; empty if it is none."""
    unit = text.strip().strip("()[]{}").strip()
    return unit if any(unit in units for units in UNITS.values()) else ""


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


class ColumnError(TraceError):
    """A column or its unit is not clear. what: "column" or "unit". role: of ROLES, or empty."""

    def __init__(self, text: str, what: Literal["column", "unit"] = "column", role: str = "") -> None:
        super().__init__(text, what, role)
        self.what, self.role = what, role

    def __str__(self) -> str:
        return str(self.args[0])


def candidates(role: str, names: Sequence[str], taken: Collection[int] = ()) -> list[int]:
    """The columns that could be this one by their names. One if it is clear, none if no name is known."""
    plain = [split_name(re.sub(r" \d+$", "", name))[0] for name in names]  # a repeated name has its column's number
    matches = [i for i, name in enumerate(plain) if name in _NAMES[role] and i not in taken]
    exact = [i for i in matches if plain[i] == role]
    return exact if len(exact) == 1 else matches


def choose_columns(names: Sequence[str], columns: Mapping[str, str | int] | None, source: str) -> dict[str, int]:
    """The index of the column for each role. columns: {"time": ""} means that no column is the time.

    Raises ColumnError that lists the names if a role is unclear.
    """
    listed = ", ".join(repr(name) for name in names[:_MOST_LISTED])
    listed += f" and {len(names) - _MOST_LISTED} more" if len(names) > _MOST_LISTED else ""
    chosen: dict[str, int] = {}
    for role, wanted in (columns or {}).items():
        if role not in ROLES:
            raise ColumnError(f"{source}: {role!r} is no role of a column; the roles are {', '.join(ROLES)}")
        if wanted == "" and role not in REQUIRED:
            continue
        if isinstance(wanted, str) and wanted in names:
            chosen[role] = list(names).index(wanted)
        elif str(wanted).isdigit() and 1 <= int(wanted) <= len(names):
            chosen[role] = int(wanted) - 1
        else:
            text = f"{source}: there is no column {wanted!r} for the {role}; the columns are {listed}"
            raise ColumnError(text, "column", role)
    for role in ROLES:
        if role in chosen or role in (columns or {}):
            continue
        matches = candidates(role, names, chosen.values())
        if len(matches) == 1:
            chosen[role] = matches[0]
        elif matches or role in REQUIRED:
            problem = f"more than one column could be the {role}" if matches else f"no column is known to be the {role}"
            text = f"{source}: {problem}; the columns are {listed}. Name one (--column {role}=NAME)"
            raise ColumnError(text, "column", role)
    return chosen


def unit_size(role: str, name: str, units: Mapping[str, str] | None, source: str) -> float:
    """The size of a column's unit in SI units, from `units` or from the column's name. Raises ColumnError."""
    written = split_name(name)[1]
    unit = (units or {}).get(role, written)
    known = ", ".join(UNITS[role])
    if not unit:
        text = f"{source}: the unit of the {role} column {name!r} is not stated: state it (--unit {role}=UNIT)"
        raise ColumnError(f"{text}; the units are {known}", "unit", role)
    if unit not in UNITS[role]:
        raise ColumnError(f"{source}: {unit!r} is no unit of the {role}; the units are {known}", "unit", role)
    return UNITS[role][unit]
