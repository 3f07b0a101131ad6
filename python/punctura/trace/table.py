"""The columns of a file, before it is known which of them is the depth, the force or the time."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from punctura.trace.trace import Finding


class Table(dict[str, NDArray[np.float64]]):
    """Columns of one length by their names, which hold their units. A cell that holds no number is NaN."""

    def __init__(self, columns: Mapping[str, NDArray[np.float64]] | None = None) -> None:
        super().__init__(columns or {})
        self.findings: list[Finding] = []  # about the file
