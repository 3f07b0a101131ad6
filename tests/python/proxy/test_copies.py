"""Each public class with a state continues with the same bits after copy, deepcopy, pickle and `state`."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import punctura as pn
import pytest
from exported import exported
from punctura.batches import LineBatch
from punctura.live import LiveEstimate
from punctura.rivals import Rival, RivalInsertion
from punctura.simulation import Experiment, Hand, Plant, RecordedMotion, Strokes, Target
from punctura.syringe import Outlet, Plunger, Syringe

T = 1 / 1600
NEEDLE, MEMBRANE, COUPLING = pn.Needle(1.08e-3, 0.28), pn.Membrane(570, 0.41, 0.2, 1e-3), pn.Coupling(400, 1)
THIN, THICK = pn.ThinLaw(NEEDLE, MEMBRANE.replace(thickness=0.0)), pn.ThickLaw(NEEDLE, MEMBRANE, 0.3)
PROFILE = pn.ProfileLaw([0, 1e-3, 2e-3], [-0.1, -1, -0.3], [0, 0.2, 0.3])
SCENE = pn.load_scene("k06-fig12")
BY_MOTION = SCENE.replace(direction="motion", servo=SCENE.servo.replace(conditioning="line_fit"))
TIME = np.arange(4000) * T
DEPTH = 3e-3 - 5e-3 * np.cos(2 * np.pi * 0.8 * TIME) + 1e-4 * np.sin(40 * TIME)
DOWN = np.array([0.0, -1.0, 0.0])
START, END = [0, 5e-3, 0], [0, -10e-3, 0]
RECORDED = RecordedMotion(TIME[::100], np.outer(DEPTH[::100], DOWN))

Part = Callable[[Any, slice], Any]


def line(model: Any, part: slice) -> Any:
    return model.run(DEPTH[part])


def space(model: Any, part: slice) -> Any:
    return model.run(np.outer(DEPTH[part], DOWN), DOWN)


def batch(model: Any, part: slice) -> Any:
    return {"force": model.run(np.outer(DEPTH[part], np.linspace(0.5, 2, model.trials)))}


def estimate(model: Any, part: slice) -> Any:
    return model.run(DEPTH[part], np.maximum(DEPTH[part], 0) * 300, T)


def plunger(model: Any, part: slice) -> Any:
    return {"force": np.array([model.step(depth, Outlet(1e11, 1e3)) for depth in DEPTH[part]])}


def operator(model: Any, part: slice) -> Any:
    return model.run(len(TIME[part]) * T)


def moved(model: Any, part: slice) -> Any:
    model.move_to(DEPTH[part][-1] * DOWN)
    return {"position": np.array(model.position)}


MADE: dict[str, tuple[Callable[[], Any], Part]] = {
    "Proxy1d, thin": (lambda: pn.Proxy1d(THIN, COUPLING, T), line),
    "Proxy1d, paper": (lambda: pn.Proxy1d(THICK, COUPLING, T, solver="paper"), line),
    "Proxy1d, profile": (lambda: pn.Proxy1d(PROFILE, COUPLING, T), line),
    "Proxy3d": (lambda: pn.Proxy3d(NEEDLE, MEMBRANE, [0, 0, 0], [0.1, -1, 0], COUPLING, T), space),
    "Proxy3d, paper": (lambda: pn.Proxy3d(NEEDLE, MEMBRANE, [0, 0, 0], [0.1, -1, 0], COUPLING, T, "paper"), space),
    "Insertion": (lambda: pn.Insertion(SCENE), space),
    "Insertion, by motion": (lambda: pn.Insertion(BY_MOTION), space),
    "LineBatch": (lambda: LineBatch([THIN, THICK, PROFILE] * 15, COUPLING, T), batch),
    "LineBatch, paper": (lambda: LineBatch(THICK, [COUPLING, pn.Coupling(700, 0.2)], T, "paper"), batch),
    "RivalInsertion": (lambda: RivalInsertion(SCENE, [Rival("dahl")]), space),
    "LiveEstimate": (lambda: LiveEstimate(noise=6e-3, least_drop=0.05), estimate),
    "Plunger": (lambda: Plunger(Syringe(15e-3, 4e-6, 0.3e-6, 0.5, 1e-12, 2e9), pn.Coupling(2000, 2), T), plunger),
    "Target": (lambda: Target(END), moved),
    "Experiment, strokes": (
        lambda: Experiment(SCENE, Strokes(START, END), hand=Hand(tremor_rms=1e-4), seed=3),
        operator,
    ),
    "Experiment, recorded": (lambda: Experiment(SCENE, RECORDED, Plant(mass=0.03)), operator),
    "Experiment, target": (lambda: Experiment(SCENE, Target(END), axis=[0.1, -1, 0], seed=9), operator),
}


def restored(one: Any, other: Any) -> Any:
    other.state = one.state
    return other


def plain(values: Any) -> dict[str, bytes]:
    """The bytes of all columns, and of what the object tells about its last tick."""
    names = values if isinstance(values, dict) else list(values)
    return {name: np.asarray(values[name]).tobytes() for name in names}


def outcome(model: Any) -> dict[str, bytes]:
    names = ("force", "offset", "position", "depth", "axial_force", "direction", "bounds", "phase", "tip", "depths")
    return {name: repr(getattr(model, name)).encode() for name in names if hasattr(type(model), name)}


def test_the_table_has_every_public_class_with_a_state() -> None:
    documents = {kind.__name__: getattr(getattr(kind, "state", None), "__doc__", None) for kind in exported().values()}
    found = {name for name, document in documents.items() if (document or "").startswith("The complete state as bytes")}
    assert found == {name.split(",")[0] for name in MADE}


@pytest.mark.parametrize("name", MADE)
@pytest.mark.parametrize("at", [0, 1, 1300, 2600])
def test_each_copy_continues_with_the_same_bits(name: str, at: int) -> None:
    make, run = MADE[name]
    model = make()
    if at:
        run(model, slice(0, at))
    used = make()
    run(used, slice(0, 700))
    others = [
        copy.copy(model),
        copy.deepcopy(model),
        pickle.loads(pickle.dumps(model)),
        restored(model, make()),
        restored(model, used),
    ]
    state, tick = model.state, outcome(model)
    wanted = plain(run(model, slice(at, None)))
    assert model.state != state
    assert any(map(any, wanted.values())), "the motion meets the membrane"
    for other in others:
        assert type(other) is type(model)
        assert (other.state, outcome(other)) == (state, tick)
        assert plain(run(other, slice(at, None))) == wanted
        assert (other.state, outcome(other)) == (model.state, outcome(model))


@pytest.mark.parametrize("name", MADE)
def test_bytes_that_are_no_state_of_this_object_are_refused(name: str) -> None:
    make, run = MADE[name]
    model = make()
    run(model, slice(0, 1300))
    kept = model.state
    assert isinstance(kept, bytes)
    foreign = pn.Proxy1d(THICK, pn.Coupling(401, 1), T).state
    damaged = bytes(kept[:-9]) + bytes([kept[-9] ^ 1]) + kept[-8:]
    for other in (b"", kept[:-1], kept + b"\0", bytes(len(kept)), foreign, damaged):
        with pytest.raises(ValueError, match="no state of this"):
            model.state = other
        assert model.state == kept
    with pytest.raises(TypeError):
        model.state = "text"


def test_the_state_of_a_batch_with_other_laws_or_couplings_is_refused() -> None:
    one = LineBatch([THIN, THICK], COUPLING, T)
    for other in (
        LineBatch([THICK, THIN], COUPLING, T),
        LineBatch([THIN, THICK], [COUPLING, pn.Coupling(401, 1)], T),
        LineBatch([THIN, THICK], COUPLING, T, "paper"),
        LineBatch([THIN, THICK, THICK], COUPLING, T),
    ):
        with pytest.raises(ValueError, match="other parameters"):
            one.state = other.state
