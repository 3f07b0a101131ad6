"""Where the needles of a MuJoCo model are, as seen from their tissues, and how they will move in a step."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from punctura import Insertion
from punctura.extras import optional

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


def without(model: Any, data: Any, seen: Relative, last: Array) -> tuple[Array, Array]:
    """Where the tips will be at the end of the step without the force of the needles, and how a force moves them.

    last (L, 3): the last force of the needles, N in the frames of the tissues, which must be in data.xfrc_applied.
    Returns positions (L, 3) in m and the compliance (3 L, 3 L) in m/N. MuJoCo's own forward dynamics with `last` gives
    the acceleration, contacts and other constraints included. What the constraints do about another force than `last`
    is not known; at rest the force does not change, so nothing is missing there.
    """
    mujoco = optional("mujoco", "mujoco", "punctura.mujoco")
    period = model.opt.timestep
    for stage in (mujoco.mj_fwdActuation, mujoco.mj_fwdAcceleration, mujoco.mj_fwdConstraint):
        stage(model, data)
    forces = np.column_stack([data.qfrc_smooth + data.qfrc_constraint, seen.jacobian.T])
    accelerations = np.linalg.solve(inertia(model, data), forces)
    compliance = period**2 * seen.jacobian @ accelerations[:, 1:]
    travel = period * seen.jacobian @ (data.qvel + period * accelerations[:, 0]) - compliance @ last.ravel()
    return seen.tip + travel.reshape(-1, 3), compliance


def mobility(model: Any, data: Any, seen: Relative) -> Array:
    """(3 L, 3 L) Acceleration of the tips per force, 1/kg."""
    result: Array = seen.jacobian @ np.linalg.solve(inertia(model, data), seen.jacobian.T)
    return result


def inertia(model: Any, data: Any) -> Array:
    """(nv, nv) What MuJoCo's integrator solves with: the inertia and the damping that it takes implicitly."""
    mujoco = optional("mujoco", "mujoco", "punctura.mujoco")
    full = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, full)
    kind, step = model.opt.integrator, model.opt.timestep
    if kind in (mujoco.mjtIntegrator.mjINT_IMPLICIT, mujoco.mjtIntegrator.mjINT_IMPLICITFAST):
        rows = np.repeat(np.arange(model.nv), model.D_rownnz)
        np.add.at(full, (rows, model.D_colind), -step * data.qDeriv)  # of the last step: it changes slowly
    elif (
        kind == mujoco.mjtIntegrator.mjINT_EULER and not model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_EULERDAMP
    ):
        full[np.diag_indices(model.nv)] += step * model.dof_damping
    return full
