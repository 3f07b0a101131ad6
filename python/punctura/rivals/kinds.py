"""The rivals by name, with their numbers, as the compiled core lists them."""

from dataclasses import dataclass
from functools import cache
from typing import Literal

from punctura._core import rival_kinds

Shows = Literal["insertion", "withdrawal", "speeds", "setting"]


@dataclass(frozen=True)
class RivalNumber:
    """A number of a rival. low and high bound every use; `default` lies between them. SI."""

    name: str  # for programs
    unit: str  # SI
    low: float
    high: float
    default: float
    what: str  # it is, in words
    shows: Shows  # what a trace must contain so that the number can be read from it; "setting": never fitted


@dataclass(frozen=True)
class RivalKind:
    """A rival: a force model of another author."""

    name: str  # for programs
    title: str  # for people
    source: str  # where it was published
    punctures: bool  # whether it has a puncture: the number "puncture"
    numbers: tuple[RivalNumber, ...]  # that it needs

    def fitted(self, shows: frozenset[Shows]) -> tuple[RivalNumber, ...]:
        """The numbers that a trace with these contents can show, without the puncture."""
        return tuple(n for n in self.numbers if n.shows in shows and n.name != "puncture")


@cache
def kinds() -> dict[str, RivalKind]:
    """All rivals, by name."""
    found = {}
    for entry in rival_kinds():
        numbers = tuple(RivalNumber(**number) for number in entry.pop("numbers"))
        found[entry["name"]] = RivalKind(numbers=numbers, **entry)
    return found
