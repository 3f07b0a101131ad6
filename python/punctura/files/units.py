"""Units in the key names of a file, and the exact conversion to and from SI."""

from decimal import Context, Decimal
from typing import NamedTuple

from punctura._core import file_units

# Precise enough that products of file values lose no digit. An overflow gives infinity, as with doubles.
_EXACT = Context(prec=2000, traps=[])


class Unit(NamedTuple):
    """A unit in a file: its name and its size in SI units."""

    name: str
    si: Decimal


# By the end of a key. A longer one stands before one that is its end.
UNITS = {suffix: Unit(name, Decimal(size)) for suffix, name, size in file_units()}
_NO_UNIT = Unit("", Decimal(1))


def split_key(key: str) -> tuple[str, Unit]:
    """Splits a key into field name and unit: `thickness_mm` gives (`thickness`, mm). A key may have no unit."""
    for suffix, unit in UNITS.items():
        if key.endswith("_" + suffix):
            return key[: -len(suffix) - 1], unit
    return key, _NO_UNIT


def to_si(value: Decimal, unit: Unit) -> float:
    """The double nearest to the written decimal in SI units: 1.08 mm is exactly the double 0.00108."""
    return float(_EXACT.multiply(value, unit.si)) if value.is_finite() else float(value)


def from_si(value: float, unit: Unit) -> Decimal:
    """A decimal number in `unit` that `to_si` converts back to exactly `value`."""
    return Decimal(repr(value)) / unit.si
