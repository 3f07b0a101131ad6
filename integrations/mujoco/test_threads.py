"""punctura.mujoco in several threads, and beside models that are loaded meanwhile. Run by test.sh."""

import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import mujoco
import numpy as np
import punctura.mujoco as pm
import pytest
from test_mujoco import away, model, push, scene

__all__ = ["away"]  # a fixture of each test


def run(integrator: str, together: Callable[[], object] = lambda: None) -> np.ndarray:
    """The forces of a push through a membrane, in a model of its own."""
    m = model(5e-3, integrator=integrator)
    together()
    d = mujoco.MjData(m)
    d.qvel[2] = -0.3
    return push(pm.attach(m, scene(0), "tip", "tissue"), d, -0.8, 0.4)


@pytest.mark.parametrize("integrator", ["Euler", "implicitfast", "RK4"])
def test_models_in_several_threads_give_the_bits_of_one_thread(integrator):
    alone, count = run(integrator), 3
    start = threading.Barrier(count)
    with ThreadPoolExecutor(count) as pool:
        together = [pool.submit(run, integrator, start.wait) for _ in range(count)]
        assert all(np.array_equal(one.result(), alone) for one in together)
    assert alone[:, 2].max() > 0.1 and mujoco.get_mjcb_control() is None


def test_models_are_loaded_while_another_thread_steps():
    ended = threading.Event()
    with ThreadPoolExecutor(1) as pool:
        stepping = pool.submit(run, "implicitfast")
        stepping.add_done_callback(lambda _: ended.set())
        loaded = 0
        while not ended.is_set() or loaded < 10:
            model(5e-3)
            loaded += 1
        stepping.result()
    assert mujoco.get_mjcb_control() is None


def test_a_second_thread_inside_acting_is_refused(monkeypatch):
    monkeypatch.setattr("punctura.mujoco.attachment._PATIENCE_S", 0.01)
    m, other = model(), model(integrator="RK4")
    attached, second = pm.attach(m, scene(0), "tip", "tissue"), pm.attach(other, scene(0), "tip", "tissue")

    def enter() -> None:
        with second.acting():
            raise AssertionError("both threads are inside")

    def step() -> None:
        second.step(mujoco.MjData(other))

    with ThreadPoolExecutor(1) as pool:
        with attached.acting():
            for use in (enter, step):
                with pytest.raises(RuntimeError, match=r"another thread is inside acting\(\).*use step"):
                    pool.submit(use).result()
            mujoco.mj_step(m, mujoco.MjData(m))
            with second.acting():  # the same thread may
                mujoco.mj_step(other, mujoco.MjData(other))
        pool.submit(step).result()
    assert mujoco.get_mjcb_control() is None


def test_a_model_that_is_loaded_inside_acting_is_refused_with_a_sentence_and_nothing_stays_behind():
    m = model()
    attached = pm.attach(m, scene(0), "tip", "tissue")
    with pytest.raises(RuntimeError, match=r"cannot load a model while .* load it before the block"), attached.acting():
        model()
    assert mujoco.get_mjcb_control() is None
    model()
    with attached.acting():
        mujoco.mj_step(m, mujoco.MjData(m))
    with pytest.raises(KeyError, match="mine"), attached.acting():
        raise KeyError("mine")
    attached.step(mujoco.MjData(m))
    assert mujoco.get_mjcb_control() is None


def test_a_model_without_actuation_has_its_needles_in_step_and_refuses_acting():
    m = model(5e-3)
    m.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ACTUATION
    d = mujoco.MjData(m)
    d.qvel[2] = -0.3
    attached = pm.attach(m, scene(0), "tip", "tissue")
    assert push(attached, d, -0.8, 0.4)[:, 2].max() > 0.1
    with pytest.raises(RuntimeError, match=r"actuation disabled.*clear mjDSBL_ACTUATION"), attached.acting():
        raise AssertionError("the needles would not act")
