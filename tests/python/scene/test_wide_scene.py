"""Scenes beyond K06: read, run, recorded, replayed, followed by events and drawn."""

from pathlib import Path

import numpy as np
import pytest
from punctura import Insertion, MaxwellBranch, Tissue, load_scene, save_scene
from punctura._core import law_curve
from punctura.events import crossing, find_events
from punctura.simulation import Experiment, Strokes

DOWN = [0.0, -1.0, 0.0]
WIDE = Path(__file__).with_name("wide.toml")


@pytest.fixture
def scene():
    return load_scene(WIDE)


def test_a_wide_scene_is_read_in_si_and_saved_again(scene, tmp_path):
    assert scene.relaxation == (MaxwellBranch(100.0, 0.2), MaxwellBranch(50.0, 3.0))
    wall, profile = (placed.tissue for placed in scene.membranes)
    assert (wall.grip, wall.growth, wall.tip_length, wall.cutting, wall.set) == ("exponential", 900.0, 3e-3, 0.2, 0.25)
    assert profile.profile[2] == (2.5e-3, -0.9, 0.1) and profile.replace(profile=()) == Tissue()
    save_scene(scene, tmp_path / "again.toml")
    assert load_scene(tmp_path / "again.toml") == scene
    paths = {field.path for field in scene.fields()}
    assert {"coupling.relaxation[1].stiffness", "membrane[1].profile[3].upper", "membrane[0].tail_floor"} <= paths
    assert scene.with_values({"membrane[1].profile[2].lower": -1.0}).membranes[1].tissue.profile[2][1] == -1.0


def test_events_and_curves_know_the_law(scene):
    wall, profile = crossing(scene, 0, 1.0), crossing(scene, 1, 1.0)
    assert wall.through == pytest.approx(3.5e-3) and profile.peak == pytest.approx(2.7e-3, abs=0.5e-3)
    ticks = Insertion(scene).run(np.outer(np.linspace(-1e-3, 14e-3, 4000), DOWN), DOWN)
    pops = [event for event in find_events(ticks, scene) if event.what == "pop"]
    assert [pop.membrane for pop in pops] == [0, 1] and all(pop.drop > 0.1 for pop in pops)
    curve = law_curve(scene, 1, 0.0)
    assert min(curve["lower"]) == pytest.approx(-0.85, abs=0.06) and max(curve["upper"]) <= 0.1


def test_an_experiment_continues_from_its_state(scene):
    one, other = (Experiment(scene, Strokes([0, 2e-3, 0], [0, -8e-3, 0])) for _ in range(2))
    one.run(300)
    other.state = one.state
    assert (one.run(100).force == other.run(100).force).all()
    with pytest.raises(ValueError):
        Experiment(load_scene("k06-fig12"), Strokes([0, 2e-3, 0], [0, -8e-3, 0])).state = one.state
