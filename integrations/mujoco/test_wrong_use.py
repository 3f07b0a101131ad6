"""Wrong use of punctura.mujoco is refused or told, with the real MuJoCo. Run by test.sh."""

import mujoco
import numpy as np
import punctura.mujoco as pm
import pytest
from test_mujoco import away, model, push, scene

__all__ = ["away"]  # a fixture of each test


def test_a_needle_that_begins_behind_a_membrane_has_no_force_and_a_warning_says_so():
    m = model(5e-3)
    d = mujoco.MjData(m)
    attached = pm.attach(m, scene(0), "tip", "tissue")
    d.qvel[2] = -0.3
    push(attached, d, -0.8, 0.2)
    copied = mujoco.MjData(m)
    mujoco.mj_copyData(copied, m, d)
    with pytest.warns(UserWarning, match=r"'tip' begins behind 'wall 0' and gets no force.*use save"):
        attached.step(copied)
    assert not attached.force(copied).any() and attached.force(d).any()


def test_steps_that_are_not_finite_are_refused_and_the_needles_stay_where_they_were():
    m = model(5e-3)
    d = mujoco.MjData(m)
    attached = pm.attach(m, scene(0), "tip", "tissue")
    attached.step(d)
    d.xfrc_applied[m.body("needle").id, 2] = np.nan
    with pytest.raises(RuntimeError, match=r"not finite: look at data\.ctrl"):
        attached.step(d)
    d.qpos[2] = np.nan  # MuJoCo itself resets such data
    with pytest.raises(RuntimeError, match="stepped, reset or set without"):
        attached.step(d)
    attached.reset(d)
    attached.step(d)
    assert np.isfinite(d.qpos).all() and mujoco.get_mjcb_control() is None


def test_wrong_use_is_refused_with_a_sentence():
    m = model()
    attached = pm.attach(m, scene(0), "tip", "tissue")
    d = mujoco.MjData(m)
    with pytest.raises(ValueError, match="has an Attachment already"):
        pm.attach(m, scene(0), "tip", "tissue")
    with attached.acting(), pytest.raises(RuntimeError, match="would make the step twice"):
        attached.step(d)
    attached.step(d)
    mujoco.mj_step(m, d)
    with pytest.raises(RuntimeError, match="stepped, reset or set without"):
        attached.step(d)
    attached.reset(d)
    attached.step(d)
    m.opt.timestep = 1e-3
    with pytest.raises(RuntimeError, match=r"was 0.002 s .* now 0.001 s"):
        attached.step(d)
    attached.detach()
    with pytest.raises(RuntimeError, match="was detached"):
        attached.step(d)
    with pytest.raises(ValueError, match="no site 'point'; it has 'tip'"):
        pm.attach(m, scene(0), "point", "tissue")
    with pytest.raises(ValueError, match="no body 'arm'; it has 'world', 'tissue', 'needle'"):
        pm.attach(m, scene(0), "tip", "arm")
    with pytest.raises(ValueError, match="'wall 1' has no body"):
        pm.attach(m, scene(0, 1), "tip", {"wall 0": "tissue"})
    with pytest.raises(TypeError, match=r"'venipuncture', not a punctura\.Scene"):
        pm.attach(m, "venipuncture", "tip", "tissue")
    with pytest.raises(ValueError, match=r"timestep is 0.02 s: needles need a time step from 0.01 ms to 10 ms"):
        pm.attach(model(timestep=0.02), scene(0), "tip", "tissue")
    with pytest.raises(ValueError, match="belongs to another model"):
        pm.attach(m, scene(0), "tip", "tissue").step(mujoco.MjData(model()))
    with pytest.raises(ValueError, match="pushed into itself"):
        pm.attach(m, scene(0), "tip", "needle")


def test_a_callback_of_the_user_still_runs_and_one_that_replaces_the_needles_is_reported():
    m = model()
    d = mujoco.MjData(m)
    attached = pm.attach(m, scene(0), "tip", "tissue")
    calls = []
    mujoco.set_mjcb_control(lambda model, data: calls.append(data.time))
    try:
        attached.step(d)
        assert calls == [0.0]
        with pytest.raises(RuntimeError, match="another mjcb_control"), attached.acting():
            mujoco.set_mjcb_control(None)
    finally:
        mujoco.set_mjcb_control(None)
