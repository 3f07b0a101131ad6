"""States of other experiments, and pickled motions. test_copies.py has the states of experiments."""

import copy
import pickle

import numpy as np
import pytest
from punctura import load_scene
from punctura.simulation import Experiment, Hand, Plant, RecordedMotion, Strokes, Target

SCENE = load_scene("k06-fig12")
START, END = [0, 5e-3, 0], [0, -10e-3, 0]
TIMES = np.linspace(0, 3, 61)
MAKERS = {
    "strokes": lambda: Experiment(SCENE, Strokes(START, END), hand=Hand(tremor_rms=1e-4), seed=3),
    "recorded": lambda: Experiment(SCENE, RecordedMotion(TIMES, np.outer(np.cos(TIMES), START)), Plant(mass=0.03)),
    "target": lambda: Experiment(SCENE, Target(START), axis=[0.1, -1, 0], seed=9),
}


@pytest.fixture(params=MAKERS)
def experiment(request):
    made = MAKERS[request.param]()
    made.run(0.9)
    if request.param == "target":
        made.move_to(END)
    return made


def test_the_state_of_another_experiment_is_refused(experiment):
    kept = experiment.state
    others = [
        Experiment(SCENE, Strokes(START, END), hand=Hand(tremor_rms=1e-4), seed=4),
        Experiment(SCENE, Strokes(START, END, count=2), hand=Hand(tremor_rms=1e-4), seed=3),
        Experiment(SCENE, RecordedMotion(TIMES[1:], np.outer(np.cos(TIMES[1:]), START)), Plant(mass=0.03)),
        Experiment(SCENE, Target(START), axis=[0, -1, 0], seed=9),
    ]
    for other in others:
        with pytest.raises(ValueError, match="no state of this Experiment"):
            experiment.state = other.state
    assert experiment.state == kept


def test_a_pickled_motion_is_the_same_motion():
    target = Target(START)
    target.move_to(END)
    for motion in (target, RecordedMotion(TIMES, np.outer(np.cos(TIMES), START)), Strokes(START, END)):
        again = pickle.loads(pickle.dumps(motion))
        runs = [Experiment(SCENE, one, seed=1).run(1.0).true_position for one in (motion, copy.copy(motion), again)]
        assert all(np.array_equal(runs[0], run) for run in runs[1:])
