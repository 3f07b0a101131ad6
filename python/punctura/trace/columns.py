"""Which column of a table is depth, force or time, and in which unit."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from punctura.trace.clock import is_stamp
from punctura.trace.names import plain_name, role_named
from punctura.trace.trace import Finding, Unstated
from punctura.trace.units import UNITS, role_of, split_name, unit_of

Array = NDArray[np.float64]
ROLES = ("depth", "force", "time")
REQUIRED = ("depth", "force")
_QUANTITIES = {"depth": "length", "force": "force", "time": "time"}
_MOST_LISTED = 30  # columns in a message
_MOST_TAKEN = 3  # columns in a finding


class Problem(NamedTuple):
    """What a file does not state, and the option that states it."""

    what: Literal["column", "unit"]
    role: str  # of ROLES, or empty
    text: str

    @property
    def option(self) -> str:
        value = {"column": "NAME", "unit": "UNIT"}[self.what]
        return f"--{self.what} {self.role}={value}"


class ColumnError(Unstated):
    """Columns or their units are not clear: all problems of a file at once."""

    def __init__(self, source: str, problems: Sequence[Problem], names: Sequence[str]) -> None:
        listed = ", ".join(repr(name) for name in names[:_MOST_LISTED])
        listed += f" and {len(names) - _MOST_LISTED} more" if len(names) > _MOST_LISTED else ""
        texts = [f"{one.text} ({one.option})" if one.role else one.text for one in problems]
        units = [f"; the units of {_QUANTITIES[one.role]} are {', '.join(UNITS[one.role])}"
                 for one in problems if one.what == "unit"]  # fmt: skip
        text = f"{source}: {'; '.join(texts)}. The columns are {listed}{''.join(units)}"
        super().__init__(text, [one.option for one in problems if one.role])
        self.problems = tuple(problems)

    @property
    def field(self) -> str:
        """The field of a form that states the first problem: `column.depth`, `unit.force`; empty if there is none."""
        first = self.problems[0]
        return f"{first.what}.{first.role}" if first.role else ""


def candidates(role: str, names: Sequence[str], taken: Collection[int] = ()) -> list[int]:
    """The columns that could be this one by their names and units. One if it is clear, none if none is known."""
    split = [split_name(re.sub(r" \d+$", "", name)) for name in names]  # a repeated name has its column's number
    named = [i for i, (name, _) in enumerate(split) if role_named(name) == role and i not in taken]
    fitting = [i for i in named if role_of(split[i][1]) in (role, "")]
    exact = [i for i in fitting if plain_name(split[i][0]) == role]
    if len(exact) == 1:
        return exact
    tiers = (
        [i for i in fitting if role_of(split[i][1]) == role],
        [i for i in fitting if not split[i][1]],
        fitting,
        by_unit(role, names, taken),
    )
    return next((tier for tier in tiers if tier), [])


def by_unit(role: str, names: Sequence[str], taken: Collection[int] = ()) -> list[int]:
    """The columns that have a unit of this one and a name that is not known. `g` may be a mass or an acceleration."""
    split = [split_name(name) for name in names]
    return [i for i, (name, unit) in enumerate(split) if role_of(unit) == role and not role_named(name)
            and i not in taken and not (name and role == "force" and unit.endswith("f"))]  # fmt: skip


def choose_columns(
    table: Mapping[str, Array],
    columns: Mapping[str, str | int] | None,
    units: Mapping[str, str] | None,
    source: str,
    needed: Collection[str] = REQUIRED,
) -> tuple[dict[str, Array], list[Finding]]:
    """The columns of the roles in SI units, and what was concluded about them.

    columns: {"time": ""} means that no column is the time. Raises ColumnError that names all that is unclear.
    """
    names = list(table)
    problems: list[Problem] = []
    findings: list[Finding] = []
    chosen: dict[str, int] = {}
    columns, units = columns or {}, units or {}
    for role, wanted in columns.items():
        found = place_of(wanted, names)
        if role not in ROLES:
            problems.append(Problem("column", "", f"{role!r} is no role of a column; the roles are {', '.join(ROLES)}"))
        elif found is not None:
            chosen[role] = found
        elif wanted != "" or role in needed:
            problems.append(Problem("column", role, f"there is no column {wanted!r} for the {role}"))
    for role in ROLES:
        if role in columns or (role not in needed and role != "time"):
            continue
        taken = list(chosen.values())
        matches = _different(candidates(role, names, taken), table)
        if len(matches) == 1:
            chosen[role] = matches[0]
            if role == "force" and (signed := _signed(matches[0], table)) is not None:
                text = f"{names[matches[0]]!r} has lost its sign, so {names[signed]!r} is taken"
                findings.append(Finding("unsigned", f"{text}: it is the same force with its sign", True))
                chosen[role] = signed
                continue
            if matches == by_unit(role, names, taken):
                text = f"{names[matches[0]]!r} is taken as the {role}: only it has a unit of {_QUANTITIES[role]}"
                findings.append(
                    Finding("column_by_unit", f"{text}. If that is wrong, name another (--column {role}=NAME)")
                )
            if role in REQUIRED and (others := _others(role, matches[0], table, taken)):
                listed = " and ".join(repr(name) for name in others[:_MOST_TAKEN])
                text = f"{names[matches[0]]!r} is taken as the {role}, and {listed} could be it, too"
                findings.append(
                    Finding("other_columns", f"{text}. If that is wrong, name another (--column {role}=NAME)")
                )
        elif matches:
            listed = ", ".join(repr(names[i]) for i in matches[:_MOST_LISTED])
            problems.append(Problem("column", role, f"more than one column could be the {role}: {listed}"))
        elif role in needed:
            problems.append(Problem("column", role, f"no column is known to be the {role}"))
            if role not in units and not any(role_of(split_name(name)[1]) == role for name in names):
                text = "; without depth, state the needle's speed (--speed-mm-per-s V)" if role == "depth" else ""
                problems.append(Problem("unit", role, f"no column has a unit of {_QUANTITIES[role]}{text}"))
    sizes = {role: _size(role, names[at], units, table, problems) for role, at in chosen.items()}
    if problems:
        raise ColumnError(source, problems, names)
    return {role: table[names[at]] * sizes[role] for role, at in chosen.items()}, findings


def place_of(wanted: str | int, names: Sequence[str]) -> int | None:
    """The place of a column that is named with or without its unit, or by its number from 1."""
    if wanted in names:
        return names.index(str(wanted))
    if str(wanted).isdigit():
        return int(wanted) - 1 if 1 <= int(wanted) <= len(names) else None
    plain = [i for i, name in enumerate(names) if split_name(name)[0] == wanted]
    return plain[0] if len(plain) == 1 else None


def _different(matches: Sequence[int], table: Mapping[str, Array]) -> list[int]:
    """Without columns that never change or that repeat another one, also with another sign, zero or unit."""
    names = list(table)
    kept: dict[int, Array] = {}
    for i in matches if len(matches) > 1 else ():
        values = table[names[i]]
        unit = split_name(names[i])[1]
        values = values * UNITS.get(role_of(unit), {}).get(unit, 1.0)
        held = values[np.isfinite(values)]
        values = values - (held[0] if len(held) else 0.0)
        alike = any(
            np.allclose(values, sign * other, rtol=1e-3, atol=1e-3 * float(np.ptp(held)), equal_nan=True)
            for other in kept.values() for sign in (1, -1) if len(held)
        )  # fmt: skip
        if len(held) and np.ptp(held) > 0 and not alike:
            kept[i] = values
    return list(kept) or list(matches)


def _others(role: str, at: int, table: Mapping[str, Array], taken: Collection[int]) -> list[str]:
    """The names of other columns that could be this one by name or unit, and differ from the one at `at`."""
    names = list(table)
    named = [i for i, (name, unit) in enumerate(map(split_name, names))
             if role_named(name) == role and role_of(unit) in (role, "") and i not in taken]  # fmt: skip
    could = sorted({*named, *by_unit(role, names, taken)} - {at})
    return [names[i] for i in _different([at, *could], table) if i != at]


def _signed(force: int, table: Mapping[str, Array]) -> int | None:
    """The column of which this force is the absolute value, where it has both signs; None if there is none."""
    names = list(table)
    values = table[names[force]]
    held = values[np.isfinite(values)]
    apart = 1e-3 * float(np.ptp(held)) if len(held) else 0.0
    for i, name in enumerate(names):
        other = table[name]
        ends = other[np.isfinite(other)] if role_of(split_name(name)[1]) == "force" else ()
        both = len(ends) > 0 and min(-float(np.min(ends)), float(np.max(ends))) > 10 * apart
        if both and np.allclose(values, np.abs(other), rtol=1e-3, atol=apart, equal_nan=True):
            return i
    return None


def _size(role: str, name: str, units: Mapping[str, str], table: Mapping[str, Array], problems: list[Problem]) -> float:
    """The size of a column's unit in SI units, from `units` or from the column's name; else there is a problem more."""
    written = split_name(name)[1]
    unit = units.get(role, written)
    if not unit and role == "time" and (is_stamp(table[name]) or any(other.startswith("field.") for other in table)):
        unit = "ns"
    size = UNITS[role].get(unit_of(unit))
    if size is None:
        text = f"{unit!r} is no unit of the {role}" if unit else f"the unit of the {role} column {name!r} is not stated"
        problems.append(Problem("unit", role, text))
    return size or np.nan
