"""Motions to simulate."""

import numpy as np

RATE = 1600.0
HEADER = "time_s,x_m,y_m,z_m"
AXIS_HEADER = HEADER + ",axis_x,axis_y,axis_z"


def strokes(rows: int, rate: float = RATE, seconds: float = 1.0, depth: float = 0.012) -> tuple[np.ndarray, np.ndarray]:
    """(time, position) of a needle that goes 12 mm down into y < 0 and up again, once every `seconds`."""
    time = np.arange(rows) / rate
    y = 0.002 - (depth + 0.002) * (0.5 - 0.5 * np.cos(2 * np.pi * time / seconds))
    return time, np.column_stack((1e-3 * np.sin(3 * time), y, np.zeros(rows)))


def rows_of(time: np.ndarray, position: np.ndarray, axis: np.ndarray | None = None, stamp: str = "%.17g") -> list[str]:
    """Lines of a motion file."""
    table = np.column_stack((time, position) if axis is None else (time, position, axis))
    return [stamp % row[0] + "".join(f",{v!r}" for v in row[1:]) for row in table.tolist()]
