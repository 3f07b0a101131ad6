"""Positions, directions and forces between the world and the frame of a body that moves."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


class Relative(NamedTuple):
    """Needles as seen from the tissue: one row or block of three for each of L needles."""

    tip: Array  # (L, 3) m, in the frame of the tissue's body
    axis: Array  # (L, 3) unit direction of the needle, in that frame
    jacobian: Array  # (3 L, nv) velocity of the tip in that frame per velocity of the model
    point: Array  # (L, 3) m, the tip in the world
    rotation: Array  # (L, 3, 3) from that frame to the world

    def in_world(self, vectors: Array) -> Array:
        """Vectors (L, 3) of the frames of the tissues, in the world."""
        turned: Array = np.einsum("lij,lj->li", self.rotation, vectors)
        return turned


def seen_from(
    tip: Array, axis: Array, needle_jacobian: Array, origin: Array, rotation: Array, tissue_jacobian: Array
) -> tuple[Array, Array, Array]:
    """(tip, axis, jacobian) of one needle in the frame of a body.

    tip, axis, origin (3,): in the world. rotation (3, 3): from the body's frame to the world. needle_jacobian,
    tissue_jacobian (3, nv): velocity in the world of the point of needle and tissue that is now at the tip. Their
    difference, turned into the frame, is the rate of the tip's coordinates in the frame, also if the frame turns.
    """
    return rotation.T @ (tip - origin), rotation.T @ axis, rotation.T @ (needle_jacobian - tissue_jacobian)
