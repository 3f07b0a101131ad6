"""How many random cases a test draws: its own number, or PUNCTURA_CASES if that is set.

PUNCTURA_CASES=1000000 pytest tests/python        a long night
PUNCTURA_CASES=20 pytest tests/python             a first look
"""

import os
from collections.abc import Iterator


def count(usual: int) -> int:
    """The number of random cases for a test that usually draws `usual`."""
    return int(os.environ.get("PUNCTURA_CASES", usual))


def batches(usual: int, size: int) -> Iterator[tuple[int, int]]:
    """(seed, number of cases) of batches of at most `size`, together `count(usual)` cases."""
    left, seed = count(usual), 0
    while left > 0:
        yield seed, min(size, left)
        left, seed = left - size, seed + 1
