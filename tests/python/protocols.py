"""Small protocols: their scenes are made without solving, so they load fast."""

from __future__ import annotations

from pathlib import Path

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
YES = """
title = "Was there a pop?"
question = "Did it pop?"
scene = "k06-fig10"
method = "constant"
task = "yes_no"
seed = 4
[stimulus]
variable = "membrane[0].thickness"
levels = [0.0002, 0.001, 0.002, 0.003, 0.004, 0.006]
[trials]
per_level = 20
practice = 2
catch = 30
catch_level = 0.012
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "mine.toml"
    path.write_text(text)
    return path
