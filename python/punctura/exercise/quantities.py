"""Numbers as words, for sentences."""

import math
from decimal import ROUND_HALF_UP, Decimal


def tenths(value: float) -> str:
    """The value with one decimal, rounded like on the page: a half goes up."""
    return str(Decimal(value).quantize(Decimal("0.1"), ROUND_HALF_UP))


def mm(metres: float) -> str:
    return f"{tenths(metres * 1e3)} mm"


def no_more_than(metres: float) -> str:
    """The largest distance; what is rounded to nothing has no number."""
    return more(metres) if metres < 0.05e-3 else f"at most {mm(metres)}"


def more(metres: float) -> str:
    """A distance that is not zero; what is rounded to nothing has no number."""
    return "less than 0.1 mm" if metres < 0.05e-3 else mm(metres)


def millilitres(cubic_metres: float) -> str:
    return f"{tenths(cubic_metres * 1e6)} mL"


def speed(metres_per_second: float) -> str:
    fast = metres_per_second >= 9.95e-3
    return f"{metres_per_second * 1e3:.0f} mm/s" if fast else f"{tenths(metres_per_second * 1e3)} mm/s"


def degrees(radians: float) -> str:
    whole = round(math.degrees(radians))
    return f"{whole} degree{'s' * (whole != 1)}"


def times(count: int) -> str:
    return {1: "once", 2: "twice"}.get(count, f"{count} times")
