"""The conversion of tick phases to stages of a stroke."""

import numpy as np
import pytest
from punctura import Phase
from punctura.reproduce.experiment import stages

CODES = {
    "o": Phase.outside, "s": Phase.sticking, "i": Phase.sliding_in, "x": Phase.sliding_out,
}  # fmt: skip
LETTERS = {"outside": "O", "insertion": "I", "reversal": "R", "withdrawal": "W"}


def letters(*membranes: str) -> str:
    phase = np.array([[int(CODES[c]) for c in one] for one in membranes], dtype=np.uint8).T
    return "".join(LETTERS[str(stage)] for stage in stages(phase))


@pytest.mark.parametrize(
    ("phases", "expected"),
    [
        ("ooiiixxxoo", "OOIIIWWWOO"),
        ("ooisisixxo", "OOIIIIIWWO"),  # sticking between counts of the encoder
        ("oiisssxxso", "OIIRRRWWWO"),  # sticking at the reversal
        ("oisssio", "OIIIIIO"),  # a rest on the way in
        ("osio", "OIIO"),  # sticking at first contact
        ("oo", "OO"),
    ],
)
def test_sticking_between_equal_slides_belongs_to_them_and_otherwise_is_a_reversal(phases: str, expected: str) -> None:
    assert letters(phases) == expected


def test_the_needle_slides_when_it_slides_in_every_membrane_it_is_in() -> None:
    assert letters("iiiisssxxo", "ooiissxxoo") == "IIIIRRRWWO"
