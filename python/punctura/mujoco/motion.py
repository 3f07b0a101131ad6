"""How a MuJoCo model will move in the step that begins now."""

from __future__ import annotations

from typing import Any

import numpy as np

from punctura.extras import optional
from punctura.mujoco.frames import Array, Relative


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
