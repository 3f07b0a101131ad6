"""Proxies and insertions: peek, reset, other threads, wrong arguments. test_copies.py has their states."""

import copy
import pickle
import threading
from array import array

import numpy as np
import pytest
from punctura import Coupling, Insertion, Membrane, Needle, Proxy1d, Proxy3d, ThickLaw, ThinLaw, load_scene

NEEDLE, MEMBRANE, COUPLING = Needle(1.08e-3, 0.28), Membrane(570, 0.41, 0.2, 1e-3), Coupling(400, 1)
T = 1 / 1600
DOWN = [0.0, -1.0, 0.0]


def depths():
    t = np.arange(4000) * T
    return 3e-3 - 5e-3 * np.cos(2 * np.pi * 0.8 * t) + 1e-4 * np.sin(40 * t)


def positions():
    p = np.zeros((4000, 3))
    p[:, 1] = -depths()
    return p


def scene(**changes):
    made = load_scene("k06-fig12")
    return made.replace(**changes) if changes else made


MAKERS = {
    "thin line": lambda: Proxy1d(ThinLaw(NEEDLE, MEMBRANE.replace(thickness=0.0)), COUPLING, T),
    "thick line, paper": lambda: Proxy1d(ThickLaw(NEEDLE, MEMBRANE, 0.3), COUPLING, T, solver="paper"),
    "space": lambda: Proxy3d(NEEDLE, MEMBRANE, [0, 0, 0], [0.1, -1, 0], COUPLING, T),
    "insertion": lambda: Insertion(scene()),
    "insertion by motion": lambda: Insertion(
        scene(direction="motion", servo=load_scene("k06-fig12").servo.replace(conditioning="line_fit"))
    ),
}


def run(model, part):
    if isinstance(model, Proxy1d):
        return model.run(depths()[part]).force
    return model.run(positions()[part], DOWN).force


@pytest.fixture(params=MAKERS)
def model(request):
    return MAKERS[request.param]()


def test_peek_gives_what_a_step_would_and_changes_nothing(model):
    for k in (0, 1, 700, 1300, 2000):
        run(model, slice(k, k + 1))
        args = (depths()[k + 1],) if isinstance(model, Proxy1d) else (positions()[k + 1], DOWN)
        before = model.state
        peeked = model.peek(*args)
        assert model.state == before
        assert np.array_equal(peeked, model.step(*args))
    with pytest.raises(ValueError, match="p must be finite"):
        model.peek(*((float("nan"),) if isinstance(model, Proxy1d) else ([0, float("nan"), 0], DOWN)))


def test_during_run_no_other_thread_can_use_the_object(model):
    run(model, slice(0, 1300))
    kept, copied = model.state, copy.copy(model)
    long = np.repeat(depths(), 150)
    moves = (long,) if isinstance(model, Proxy1d) else (np.outer(long, [0, -1, 0]), DOWN)
    runner = threading.Thread(target=lambda: model.run(*moves))
    runner.start()
    refused = 0
    while runner.is_alive():
        try:
            model.state = kept
            pickle.dumps(model)
            copy.deepcopy(model)
            model.reset()
        except RuntimeError as error:
            assert "copy of its own" in str(error)
            refused += 1
    runner.join()
    assert refused > 0
    model.state = kept
    assert np.array_equal(run(model, slice(1300, None)), run(copied, slice(1300, None)))


def test_after_a_reset_nothing_is_left_of_what_was(model):
    fresh = model.state
    run(model, slice(0, 1300))
    model.reset()
    assert model.state == fresh


def test_the_classes_are_final():
    for base in (Proxy1d, Proxy3d, Insertion):
        with pytest.raises(TypeError):
            type("Own", (base,), {})


def test_a_position_beyond_1000_km_is_refused(model):
    far = [1e300] if isinstance(model, Proxy1d) else [[0.0, -1.1e6, 0.0]]
    before = model.state
    with pytest.raises(ValueError, match="within 1000 km"):
        model.run(far, *([] if isinstance(model, Proxy1d) else [DOWN]))
    assert model.state == before


def test_laws_are_values():
    law = ThickLaw(NEEDLE, MEMBRANE, 0.3)
    assert pickle.loads(pickle.dumps(law)) == law == ThickLaw(NEEDLE, MEMBRANE, obliquity=0.3)
    assert law != ThickLaw(NEEDLE, MEMBRANE) and hash(law) == hash(ThickLaw(NEEDLE, MEMBRANE, 0.3))
    assert repr(law).startswith("ThickLaw(needle=Needle(diameter=0.00108")
    assert law.replace(obliquity=0.0) == ThickLaw(NEEDLE, MEMBRANE)
    thin = ThinLaw(NEEDLE, MEMBRANE)
    assert pickle.loads(pickle.dumps(thin)) == thin and thin.needle == NEEDLE


@pytest.mark.parametrize(
    "vector",
    [
        np.array([0, -2e-3, 0]),
        np.array([0, -2e-3, 0], dtype=np.float32),
        np.arange(9.0)[::3] * [0, -2e-3 / 3, 0],
        np.array([0, -2e-3, 0], dtype=">f8"),
        array("d", [0, -2e-3, 0]),
        np.array([[0, 9.0], [-2e-3, 9], [0, 9]])[:, 0],  # not in a row
        (0, -2e-3, 0),
    ],
)
def test_a_step_takes_any_three_numbers(vector):
    assert Insertion(scene()).step(vector, DOWN) == Insertion(scene()).step([float(x) for x in vector], DOWN)


@pytest.mark.parametrize(
    "bad", [np.zeros(2), np.zeros((1, 3)), [0, 1], "abc", b"abc", bytearray(3), None, np.array(["a", "b", "c"])]
)
def test_a_step_refuses_what_is_not_three_numbers(bad):
    with pytest.raises(TypeError):
        Insertion(scene()).step(bad, DOWN)
