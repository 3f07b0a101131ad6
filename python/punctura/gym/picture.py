"""A small picture of a trial: needle and layers, and beside them the force at each depth of the tip, by NumPy alone."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from punctura import Scene

Image = npt.NDArray[np.uint8]
Vector = npt.NDArray[np.float64]

HEIGHT, SLICE, CURVE = 240, 240, 120  # pixels: of the picture, and the widths of its two parts
_ABOVE, _BELOW = 0.012, 0.012  # m of view above the skin, and behind the last wall
_MOST = 3.0  # N at the right end of the curve; half of that at its left end. A greater force is drawn at the end
_AIR, _WALL, _NEEDLE = np.array([238, 242, 246]), np.array([122, 62, 54]), np.array([70, 84, 98])
_INK, _ZERO, _GRID = np.array([20, 28, 36]), np.array([140, 150, 158]), np.array([216, 220, 224])
_LAYERS = np.array([(242, 208, 164), (224, 150, 140), (196, 96, 88), (232, 186, 150), (206, 126, 120), (240, 216, 190)])


class Picture:
    """The picture of one trial. `add` takes each observation's moment; `draw` gives the pixels.

    Both parts have the same scale of depth. The dark line of the curve's grid is 0 N, and a line is 1 N from the next.
    """

    def __init__(self, scene: Scene, start: Vector, axis: Vector) -> None:
        """start: the tip at travel 0, m, (3,). axis: direction of the needle, (3,)."""
        self._start, self._axis = start[:2], axis[:2] / np.linalg.norm(axis[:2])
        self._radius, self._slope = scene.needle.diameter / 2, math.tan(scene.needle.tip_angle)
        surfaces = [np.array(m.point)[:2] for m in scene.membranes]
        last = min(point[1] for point in surfaces)
        self._pixel = (_ABOVE + _BELOW - last) / HEIGHT
        y = _ABOVE - (np.arange(HEIGHT) + 0.5) * self._pixel
        middle = self._start[0] + self._axis[0] * (last / 2 - self._start[1]) / self._axis[1]
        x = middle + (np.arange(SLICE) + 0.5 - SLICE / 2) * self._pixel
        self._x, self._y = np.meshgrid(x, y)
        self._tissue = self._layers(scene, surfaces)
        self._moments: list[tuple[float, float, float]] = []  # travel (m), lowest and highest force (N)

    def add(self, travel: float, lowest_force: float, highest_force: float) -> None:
        """travel: m along the needle since the start. Forces against the needle's direction, N."""
        self._moments.append((travel, lowest_force, highest_force))

    def draw(self) -> Image:
        """(HEIGHT, SLICE + CURVE, 3) RGB."""
        picture = np.empty((HEIGHT, SLICE + CURVE, 3), np.uint8)
        picture[:, :SLICE] = self._tissue
        picture[:, :SLICE][self._needle(self._moments[-1][0] if self._moments else 0.0)] = _NEEDLE
        picture[:, SLICE:] = self._curve()
        return picture

    def _layers(self, scene: Scene, surfaces: list[Vector]) -> Image:
        behind = np.zeros(self._x.shape, int)
        wall = np.zeros(self._x.shape, bool)
        for one, point in zip(scene.membranes, surfaces, strict=True):
            nx, ny = np.array(one.inward_normal)[:2]
            depth = nx * (self._x - point[0]) + ny * (self._y - point[1])
            behind += depth > 0
            wall |= (depth > 0) & (depth < max(one.membrane.thickness, 1.5 * self._pixel))
        tissue = np.where((behind == 0)[..., None], _AIR, _LAYERS[(behind - 1) % len(_LAYERS)])
        tissue[wall] = (tissue[wall] + 2 * _WALL) // 3
        return tissue.astype(np.uint8)

    def _needle(self, travel: float) -> npt.NDArray[np.bool_]:
        """The pixels of the needle: a tube that ends in a slanted face. A thin one is shown 3 pixels thick."""
        radius = max(self._radius, 1.5 * self._pixel)
        tip = self._start + travel * self._axis
        x, y = self._x - tip[0], self._y - tip[1]
        along = x * self._axis[0] + y * self._axis[1]
        across = y * self._axis[0] - x * self._axis[1]
        face = np.minimum((across - radius + self._pixel) / self._slope, self._pixel / 2)  # its point fills a pixel
        inside: npt.NDArray[np.bool_] = (np.abs(across) <= radius) & (along <= face)
        return inside

    def _curve(self) -> Image:
        part = np.full((HEIGHT, CURVE, 3), 255, np.uint8)
        zero, newton = CURVE / 3, (2 / 3 * CURVE - 1) / _MOST  # pixels; forces that pull are on the left
        for n in range(-int(_MOST / 2), int(_MOST) + 1):
            part[:, round(zero + n * newton)] = _GRID if n else _ZERO
        if not self._moments:
            return part
        travel, lowest, highest = np.array(self._moments).T
        height = self._start[1] + travel * self._axis[1]
        rows = np.floor((_ABOVE - height) / self._pixel).astype(int)
        columns = np.clip(np.round(zero + newton * np.stack([lowest, highest])).astype(int), 0, CURVE - 1)
        for row, left, right in zip(rows, *columns, strict=True):
            if 0 <= row < HEIGHT:
                part[row, left : right + 1] = _NEEDLE
        self._join(part, rows, columns)
        return part

    def _join(self, part: Image, rows: npt.NDArray[np.int_], columns: npt.NDArray[np.int_]) -> None:
        """Lines from each moment's highest force to the next one's."""
        high = columns[1]
        for i in range(len(rows) - 1):
            n = max(abs(rows[i + 1] - rows[i]), abs(high[i + 1] - high[i]), 1)
            line = np.linspace((rows[i], high[i]), (rows[i + 1], high[i + 1]), n + 1).round().astype(int)
            line = line[(line[:, 0] >= 0) & (line[:, 0] < HEIGHT)]
            part[line[:, 0], line[:, 1]] = _INK
