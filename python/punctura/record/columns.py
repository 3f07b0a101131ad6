"""The columns of a recording: those of a tick (docs/tick.md), and two that only a recording has."""

from __future__ import annotations

from typing import Any

from numpy.typing import NDArray

from punctura.ticks import FIELDS

Columns = dict[str, NDArray[Any]]

LOST = "lost"  # ticks that are missing between the row before and this one
NEW_SCENES = "new_scenes"  # the scenes taken before this tick's step, as TOML; null in most rows

INPUTS = [field.name for field in FIELDS.values() if field.input]  # what a tick was given
