"""How many random cases a test draws: its own number, or PUNCTURA_CASES if that is set.

PUNCTURA_CASES=1000000 pytest tests/python        takes hours
PUNCTURA_CASES=20 pytest tests/python             a quick check
PUNCTURA_CASES=1/16 pytest tests/python           a part of each test's own number, as ./test does

The comparisons with the oracles go on batch by batch to any number; a test that holds all its cases at once stops
at MOST.
"""

import os
from collections.abc import Iterator
from fractions import Fraction

MOST = 2000


def asked(usual: int) -> int:
    """PUNCTURA_CASES, a part of the usual number if that is below one, or the usual number."""
    wanted = Fraction(os.environ.get("PUNCTURA_CASES", usual))
    return int(wanted if wanted >= 1 else wanted * usual)


def count(usual: int) -> int:
    """The number of random cases for a test that holds them all at once and usually draws `usual`."""
    return min(asked(usual), MOST)


def batches(usual: int, size: int) -> Iterator[tuple[int, int]]:
    """(seed, number of cases) of batches of at most `size`, together PUNCTURA_CASES or `usual` cases."""
    left, seed = asked(usual), 0
    while left > 0:
        yield seed, min(size, left)
        left, seed = left - size, seed + 1
