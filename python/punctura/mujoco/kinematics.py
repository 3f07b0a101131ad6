"""Where the needles of a MuJoCo model are, as seen from their tissues."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from punctura import Insertion
from punctura.extras import optional
from punctura.mujoco.frames import Array, Relative, seen_from


class Link(NamedTuple):
    """A needle and a body that carries membranes of it."""

    needle: str  # name of the site
    tissue: str  # name of the body
    site: int
    holder: int  # the body of the site
    body: int
    insertion: Insertion  # the model before its first tick, in the frame of the body


def relative(model: Any, data: Any, links: list[Link]) -> Relative:
    """Where the needles are in the frames of their tissues, and their Jacobians there. Needs kinematics that are up to
    date."""
    mujoco = optional("mujoco", "mujoco", "punctura.mujoco")
    tips: list[Array] = []
    axes: list[Array] = []
    jacobians: list[Array] = []
    rotations = []
    needle_jacobian, tissue_jacobian = np.empty((3, model.nv)), np.empty((3, model.nv))
    for link in links:
        tip, frame = data.site_xpos[link.site], data.site_xmat[link.site].reshape(3, 3)
        rotation = data.xmat[link.body].reshape(3, 3)
        mujoco.mj_jac(model, data, needle_jacobian, None, tip, link.holder)
        mujoco.mj_jac(model, data, tissue_jacobian, None, tip, link.body)
        seen = seen_from(tip, frame[:, 2], needle_jacobian, data.xpos[link.body], rotation, tissue_jacobian)
        for part, whole in zip(seen, (tips, axes, jacobians), strict=True):
            whole.append(part)
        rotations.append(rotation.copy())
    points = data.site_xpos[[link.site for link in links]]
    return Relative(np.array(tips), np.array(axes), np.concatenate(jacobians), points, np.array(rotations))
