"""Units in the key names of a file, and the exact conversion to and from SI."""

from __future__ import annotations

from decimal import Context, Decimal
from typing import NamedTuple

# pi/180 with more digits than a double, so that an angle in degrees is rounded only once.
_RAD_PER_DEG = Decimal("0.017453292519943295769236907684886127134428718885417")

# Precise enough that products of file values lose no digit. An overflow gives infinity, as with doubles.
_EXACT = Context(prec=2000, traps=[])


class Unit(NamedTuple):
    """A unit in a file: its name and its size in SI units."""

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
    "per_mm": Unit("1/mm", Decimal(1000)),
    "N_per_mm": Unit("N/mm", Decimal(1000)),
    "Ns_per_mm": Unit("N s/mm", Decimal(1000)),
    "mL": Unit("mL", Decimal("1e-6")),
    "kPa": Unit("kPa", Decimal(1000)),
    "mL_per_kPa": Unit("mL/kPa", Decimal("1e-9")),
    "kPa_s_per_mL": Unit("kPa s/mL", Decimal("1e9")),
}
_NO_UNIT = Unit("", Decimal(1))


def split_key(key: str) -> tuple[str, Unit]:
    """Splits a key into field name and unit: `thickness_mm` gives (`thickness`, mm). A key may have no unit."""
    for suffix in sorted(UNITS, key=len, reverse=True):
        if key.endswith("_" + suffix):
            return key[: -len(suffix) - 1], UNITS[suffix]
    return key, _NO_UNIT


def to_si(value: Decimal, unit: Unit) -> float:
    """The double nearest to the written decimal in SI units: 1.08 mm is exactly the double 0.00108."""
    return float(_EXACT.multiply(value, unit.si)) if value.is_finite() else float(value)


def from_si(value: float, unit: Unit) -> Decimal:
    """A decimal number in `unit` that `to_si` converts back to exactly `value`."""
    return Decimal(repr(value)) / unit.si
