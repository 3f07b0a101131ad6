"""punctura.batch: each trial has the numbers of the same trial alone."""

import numpy as np
import pyarrow as pa
import pytest
from numpy.typing import NDArray
from punctura import ConfigurationError, Insertion, batch, grid, load_scene
from punctura.compare.run import Run
from punctura.compare.statistics import statistics
from punctura.simulation import Hand, Plant, RecordedMotion, Strokes

SCENE = load_scene("k06-fig12")
NORMAL = np.array(SCENE.membranes[0].inward_normal)
FRONT = np.array(SCENE.membranes[0].point) - 3e-3 * NORMAL
STROKES = Strokes(list(FRONT), list(FRONT + 12e-3 * NORMAL), count=1, duration=0.3, rest=0.05)
VARY = grid({"membrane[0].friction": [0.1, 0.2], "hand.stiffness": [300, 700], "strokes.duration": [0.25, 0.4]})


def test_a_hand_gives_the_statistics_of_the_run_alone() -> None:
    result = batch(SCENE, STROKES, vary=VARY, seeds=5, duration=0.8, keep_force=True, threads=2)
    assert len(result) == 8 and result.seeds.tolist() == list(range(5, 13))
    assert result.force is not None and result.force.shape == (8, 1280, 3)
    for i in (0, 3, 7):
        ticks = result.experiment(i).run(0.8)
        alone = statistics(Run.of_ticks("alone", result.scene(i), ticks))
        assert np.array_equal(result.force[i], ticks.model_force)
        assert result.peak[i] == pytest.approx(alone.peak, rel=1e-12)
        assert result.felt_peak[i] == pytest.approx(alone.felt_peak, rel=1e-12)
        assert result.depth[i] == pytest.approx(alone.depth, rel=1e-12)
        assert result.work[i] == pytest.approx(alone.work, rel=1e-9)
        assert result.dwell[i] == pytest.approx(np.isin(ticks.phase, (1, 2, 3)).any(axis=1).sum() / 1600)
        assert result.pops[i].sum() == len(alone.pops) > 0
        for pop in alone.pops:
            assert result.drop[i, pop.membrane] == pytest.approx(pop.drop, rel=1e-12)
            assert result.overshoot[i, pop.membrane] == pytest.approx(pop.overshoot, rel=1e-9)
    assert np.ptp(result.peak) > 0


def positions(ticks: int = 900) -> NDArray[np.float64]:
    depth = 13e-3 * np.sin(np.pi * np.arange(ticks) / ticks) ** 2
    return np.asarray(FRONT + depth[:, None] * NORMAL)


def test_positions_give_the_forces_of_an_insertion() -> None:
    p = positions()
    scenes = [SCENE.with_values({"membrane[0].friction": mu}) for mu in (0.1, 0.15, 0.3)]
    result = batch(scenes, p, keep_force=True)
    assert result.force is not None and np.isnan(result.felt_peak).all()
    for scene, force in zip(scenes, result.force, strict=True):
        assert np.array_equal(force, Insertion(scene).run(p, NORMAL).force)
    own = batch(scenes, np.array([p, p[::-1], p + 1e-4]), keep_force=True)
    assert own.force is not None
    assert np.array_equal(own.force[1], Insertion(scenes[1]).run(p[::-1], NORMAL).force)
    with pytest.raises(ValueError, match="simulate"):
        own.experiment(0)


def test_recorded_motion_other_hands_and_a_table() -> None:
    p = positions()
    motion = RecordedMotion(np.arange(len(p)) / 1600, p)
    given = batch(SCENE, motion, trials=4, plant=Plant(friction=0), hand=Hand(tremor_rms=0), seeds=[1, 2, 3, 4])
    assert np.ptp(given.peak) > 0  # the seed moves the steps of the encoders
    table = given.to_arrow()
    assert isinstance(table, pa.Table) and table.num_rows == 4
    assert table["seed"].to_pylist() == [1, 2, 3, 4] and table["fault"].to_pylist() == ["none"] * 4
    assert table["drop[0]"].to_pylist() == given.drop[:, 0].tolist()
    never = batch(SCENE, p - 0.05 * NORMAL)  # in front of all membranes
    assert never.pops.sum() == 0 and never.to_arrow()["drop[0]"].to_pylist() == [None]
    assert repr(given) == "<BatchResult of 4 runs>" and repr(never) == "<BatchResult of 1 run>"
    for i in (4, -5):
        with pytest.raises(IndexError, match=rf"there is no run {i}: this batch has 4"):
            given.scene(i)
        with pytest.raises(IndexError, match="there is no run"):
            given.experiment(i)


def test_wrong_arguments() -> None:
    with pytest.raises(ConfigurationError, match=r"trial 2: membrane\[0\]\.friction"):
        batch(SCENE, STROKES, vary={"membrane[0].friction": [0.2, 0.3, -1]})
    with pytest.raises(ConfigurationError, match=r"trial 0: duration = .*at most 1e9 ticks"):
        batch(SCENE, STROKES, duration=1e12)
    with pytest.raises(ValueError, match="different numbers of trials"):
        batch(SCENE, STROKES, vary={"hand.mass": [0.1, 0.2]}, trials=3)
    with pytest.raises(ValueError, match="instructions"):
        batch(SCENE, STROKES, trials=2, instructions="mmx")
    with pytest.raises(ValueError, match="keep_force needs a duration"):
        batch(SCENE, STROKES, trials=2, keep_force=True)
    with pytest.raises(ValueError, match=r"scene\[1\] differs"):
        batch([SCENE, load_scene("k06-fig10")], STROKES)
    for message, wrong in {
        r"trials: 2, scene: 3": {"scene": [SCENE] * 3, "trials": 2},
        r"trials must be a whole number, 1 or more, not 2\.5": {"trials": 2.5},
        r"seeds must hold whole numbers": {"trials": 2, "seeds": 1.5},
        r"seeds\[1\] must be a whole number, not 2\.5": {"seeds": np.array([1, 2.5], object)},
        r"seeds must be from 0 to 2\^64 - 1, not -1": {"trials": 2, "seeds": -1},
        r"too large to count up": {"trials": 2, "seeds": 2**64 - 1},
        r"seeds must be one number, or have shape \(2,\)": {"trials": 2, "seeds": np.ones((2, 2), int)},
        r"motion must hold real numbers, not complex128": {"motion": positions() + 0j},
        r"its rows have different lengths": {"motion": [[0, 0, 0], [0, 0]]},
        r"no number hand\.stifness; did you mean hand\.stiffness\?": {"vary": {"hand.stifness": [1, 2]}},
        r"vary: hand\.mass is empty": {"vary": {"hand.mass": []}},
        r"vary: a path is a text such as .*, not 3": {"vary": {3: [1, 2]}},
        r"axis has the shape \(2,\); with a simulated hand it needs \(3,\)": {"axis": [0, 1]},
        r"duration is for a simulated hand; motion is positions": {"motion": positions(), "duration": 9.0},
        r"hand is for a simulated hand": {"motion": positions(), "hand": Hand()},
        r"scene must be a Scene or a list of Scenes, not 'k06-fig12'": {"scene": "k06-fig12"},
        r"scene must be a Scene or a list of Scenes, not None": {"scene": None},
        r"threads must be a whole number from 0 to 4096, not -1": {"threads": -1},
        r"threads must be a whole number .*, not 1\.5": {"threads": 1.5},
        r"duration must be 0 s or more, not '1'": {"duration": "1"},
        r"vary: hand\.mass must hold real numbers, not text": {"vary": {"hand.mass": ["0.1"]}},
        r"1000000000000 trials need .* GB of memory": {"trials": 10**12},
        r"with the force of each of 1600000 ticks need": {"trials": 10**6, "duration": 1e3, "keep_force": True},
    }.items():
        with pytest.raises((ValueError, TypeError, MemoryError), match=message):
            batch(**({"scene": SCENE, "motion": STROKES} | wrong))  # type: ignore[arg-type]
    for message, values in {
        r"grid: a has masked elements": {"a": np.ma.array([1.0, 2.0], mask=[0, 1])},
        r"grid: a has the shape \(2, 2\); give a list": {"a": np.ones((2, 2))},
        r"grid: a must hold real numbers, not text": {"a": ["x"]},
        r"1000000000000000 combinations need": {path: np.ones(10**5) for path in "abc"},
    }.items():
        with pytest.raises((ValueError, TypeError, MemoryError), match=message):
            grid(values)
    bad = positions()
    bad[3, 1] = np.nan
    with pytest.raises(ValueError, match=r"motion\[3\]"):
        batch(SCENE, bad)
