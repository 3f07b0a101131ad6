"""The units in the names of a file's keys, and the exact conversion to and from SI."""

from __future__ import annotations

from decimal import Context, Decimal
from typing import NamedTuple

# pi/180 to more digits than a double holds, so that an angle in degrees is rounded once only.
_RAD_PER_DEG = Decimal("0.017453292519943295769236907684886127134428718885417")

# Of products of what a file can hold no digit is lost; one beyond a Decimal's range is infinite, as a double is.
_EXACT = Context(prec=2000, traps=[])


class Unit(NamedTuple):
    """A unit as people write it: its name and how many SI units it is."""

    name: str
    si: Decimal


UNITS = {
    "mm": Unit("mm", Decimal("0.001")),
    "rad": Unit("rad", Decimal(1)),
    "deg": Unit("deg", _RAD_PER_DEG),
    "s": Unit("s", Decimal(1)),
    "ms": Unit("ms", Decimal("0.001")),
    "m_per_s": Unit("m/s", Decimal(1)),
    "hz": Unit("Hz", Decimal(1)),
    "N": Unit("N", Decimal(1)),
    "N_per_mm": Unit("N/mm", Decimal(1000)),
    "Ns_per_mm": Unit("N s/mm", Decimal(1000)),
}
_NO_UNIT = Unit("", Decimal(1))


def split_key(key: str) -> tuple[str, Unit]:
    """Field name and unit of a key: `thickness_mm` is (`thickness`, mm); a key without a unit is its own name."""
    for suffix in sorted(UNITS, key=len, reverse=True):
        if key.endswith("_" + suffix):
            return key[: -len(suffix) - 1], UNITS[suffix]
    return key, _NO_UNIT


def to_si(value: Decimal, unit: Unit) -> float:
    """The double nearest to the written decimal in SI units: 1.08 mm is exactly the double 0.00108."""
    return float(_EXACT.multiply(value, unit.si)) if value.is_finite() else float(value)


def from_si(value: float, unit: Unit) -> Decimal:
    """The decimal number in `unit` that `to_si` turns back into the very same double."""
    return Decimal(repr(value)) / unit.si
