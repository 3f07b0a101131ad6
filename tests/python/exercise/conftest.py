"""Exercises in files of their own."""

from collections.abc import Callable
from pathlib import Path

import pytest
from attempts import HEAD


@pytest.fixture
def write(tmp_path: Path) -> Callable[..., Path]:
    """An exercise file with these goals, or this text."""

    def make(*goals: str, head: str = HEAD) -> Path:
        path = tmp_path / "test.toml"
        path.write_text(head + "".join(goals), encoding="utf-8")
        return path

    return make
