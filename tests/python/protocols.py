"""Small protocols. Only the scenes of SOLVED are solved for, which takes long."""

import re
from collections.abc import Iterable
from pathlib import Path

from punctura.perception.course import Kind, Line

COMPARES = """
title = "Two intervals around a reference"
question = "Which one fell more?"
scene = "k06-fig10"
method = "constant"
task = "two_intervals"
seed = 3
[stimulus]
variable = "membrane[0].precompression"
levels = [0.2, 0.3, 0.36, 0.46, 0.52, 0.62]
reference = 0.41
[trials]
per_level = 20
blocks = 2
"""
RIGHT = (
    COMPARES.replace("[0.2, 0.3, 0.36, 0.46, 0.52, 0.62]", "[0.42, 0.43, 0.45, 0.47, 0.5, 0.54, 0.6, 0.7]")
    .replace('"constant"', '"quest"')
    .replace("per_level = 20\nblocks = 2", "total = 120")
)
ADJUST = (
    COMPARES.replace("[0.2, 0.3, 0.36, 0.46, 0.52, 0.62]", str([round(0.14 + 0.03 * i, 2) for i in range(19)]))
    .replace('"constant"', '"adjustment"')
    .replace('"two_intervals"', '"adjustment"')
    .replace("per_level = 20", "total = 12")
)
YES = """
title = "Was there a pop?"
question = "Did it pop?"
scene = "k06-fig10"
method = "constant"
task = "yes_no"
seed = 4
[stimulus]
variable = "membrane[0].thickness"
levels = [0.0005, 0.0015, 0.0021, 0.0027, 0.0033, 0.0045]
[trials]
per_level = 20
practice = 2
catch = 30
catch_level = 0.012
"""
SOLVED = """
title = "Solved"
question = "Which one fell more?"
scene = "k06-fig10"
method = "constant"
task = "two_intervals"
[stimulus]
variable = "drop_N"
levels = [0.25, 0.3, 0.35]
reference = 0.3
solve = "membrane[0].precompression"
between = [0.0, 1.5]
[trials]
per_level = 20
"""
YES_N = (
    SOLVED.replace('"two_intervals"', '"yes_no"')
    .replace("[0.25, 0.3, 0.35]", "[0.2, 0.24, 0.27, 0.3, 0.33, 0.38]")
    .replace("reference = 0.3\n", "")
    .replace("per_level = 20", "per_level = 20\ncatch = 40\ncatch_level = 0.19")
)


def with_levels(text: str, levels: Iterable[float]) -> str:
    """The protocol with other levels."""
    return re.sub(r"levels = \[.*\]", f"levels = {[round(float(one), 6) for one in levels]}", text)


def line(level: float, position: int, answer: str, kind: Kind = "trial") -> Line:
    """An answer to a level of the scene: nothing was felt."""
    return Line(trial=0, block=0, kind=kind, level=level, position=position, answer=answer, felt=())


def written(folder: Path, text: str) -> Path:
    path = folder / "mine.toml"
    path.write_text(text)
    return path
