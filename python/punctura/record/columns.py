"""The columns of a recording: the fields of a tick (docs/tick.md) and two columns of its own."""

from __future__ import annotations

from typing import Any

from numpy.typing import NDArray

from punctura.ticks import FIELDS

Columns = dict[str, NDArray[Any]]

LOST = "lost"  # number of ticks missing between the previous row and this one
NEW_SCENES = "new_scenes"  # the scenes taken before this tick's step, as TOML; null if none

INPUTS = [field.name for field in FIELDS.values() if field.input]  # the inputs of a tick
