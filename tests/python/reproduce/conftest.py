"""Makes the figures once for all tests."""

import csv
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from punctura.reproduce import Reproduction, reproduce


@pytest.fixture(scope="session")
def made(tmp_path_factory: pytest.TempPathFactory) -> Reproduction:
    """The output of `punctura reproduce`."""
    return reproduce(tmp_path_factory.mktemp("reproduction"))


@pytest.fixture(scope="session")
def column(made: Reproduction) -> Callable[..., np.ndarray]:
    """column(file, name): a column as numbers, empty cells as nan; column(file, name, str): as texts."""

    def read(file: str, name: str, kind: type = float) -> np.ndarray:
        with Path(made.folder / f"{file}.csv").open(newline="", encoding="utf-8") as stream:
            cells = [row[name] for row in csv.DictReader(stream)]
        return np.array(cells) if kind is str else np.array([float(cell or "nan") for cell in cells])

    return read
