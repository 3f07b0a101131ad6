"""Compares the event finder with a plain loop over the ticks, on random scenes, runs and batches."""

import itertools
import math

import numpy as np
import punctura as pn
import pytest
from oracles import events as oracle
from punctura import Phase
from punctura.events import EventFinder, crossing
from punctura.scene import ServoSettings
from runs import cut, moved, unit


def random_scene(random):
    needle = pn.Needle(10 ** random.uniform(-3.4, -2.7), random.uniform(0.1, 0.6))
    way = unit(random.normal(size=3))
    placed = []
    for i in range(random.integers(1, 5)):
        friction = min(1.2, random.uniform(0.02, 0.9) / math.tan(needle.tip_angle))
        thickness = random.choice([0, 10 ** random.uniform(-5, -2.3)])
        membrane = pn.Membrane(random.uniform(50, 2000), random.uniform(0, 2), friction, thickness)
        normal = unit(way + random.choice([0, 0.4]) * random.normal(size=3))
        placed.append(pn.PlacedMembrane(f"{i}", membrane, random.uniform(0, 6e-3) * way, 1.5 * normal))
    coupling = pn.Coupling(random.uniform(200, 4000), random.uniform(0, 2))
    servo = ServoSettings(rate=500, low_pass=0, solver=random.choice(["exact", "paper"]))
    return pn.Scene("random", needle, coupling, placed, servo), way


def random_run(random, scene, way):
    """Strokes with a tremor at an angle that may be grazing, with some missing numbers and some barred ticks."""
    tip = scene.needle.diameter / math.tan(scene.needle.tip_angle)
    depths = [-2e-3]
    for _ in range(random.integers(2, 5)):
        placed = scene.membranes[random.integers(0, len(scene.membranes))]
        near = way @ placed.point + tip * random.uniform(0.8, 1.0) + placed.membrane.thickness * random.uniform(0, 1)
        depths += [random.uniform(5e-3, 20e-3), near, random.choice([20e-3, random.uniform(-2e-3, 20e-3)])]
    depths.append(-3e-3)
    path = np.concatenate([np.linspace(a, b, random.integers(5, 400)) for a, b in itertools.pairwise(depths)])
    axis = unit(way + random.choice([0, 0.3, 1.5]) * random.normal(size=3))
    axis = axis if axis @ way > 0 else -axis
    position = np.outer(path, axis) + random.choice([0, 3e-5]) * random.standard_normal((len(path), 3))
    columns = moved(scene, position, axis)
    shape = columns["depth"].shape
    inside = np.isin(columns["phase"], oracle.INSIDE)
    direction = np.where(inside[..., None], columns["axis"][:, None], 0.0)
    columns["direction"] = np.where((random.random(shape) < 0.5)[..., None], direction, np.nan)
    for name, share in (("depth", 0.01), ("axial_force", 0.05), ("lower", 0.3)):
        columns[name] = np.where(random.random(shape) < share, np.nan, columns[name])
    barred = (random.random() < 0.3) & (np.arange(len(path)) % 300 > 250)[:, None] & inside
    return {**columns, "phase": np.where(barred, np.uint8(Phase.barred.value), columns["phase"])}


@pytest.mark.parametrize("seed", range(40))
def test_the_events_are_those_of_a_plain_loop_over_the_ticks(seed):
    random = np.random.default_rng(seed)
    scene, way = random_scene(random)
    columns = random_run(random, scene, way)
    expected = []
    for i, placed in enumerate(scene.membranes):
        mine = [columns[name][:, i] for name in ("phase", "depth", "axial_force", "lower", "direction")]
        for k, what, before, after in oracle.events(scene.needle, placed, *mine, columns["axis"]):
            expected.append((k, i, what, before, pytest.approx(after, rel=1e-12)))
    expected.sort(key=lambda event: event[:2])
    finder = EventFinder(scene)
    batches = cut(columns, random.integers(0, len(columns["tick"]), 60))
    found = [event for batch in batches for event in finder.add(batch)]
    assert [(e.tick, e.membrane, e.what, e.force_before, e.force_after) for e in found] == expected
    assert all(e.drop == e.force_before - e.force_after for e in found)
    assert [e.depth for e in found] == [columns["depth"][e.tick, e.membrane] for e in found]


def test_the_random_runs_have_events_of_every_kind():
    kinds = []
    for seed in range(40):
        random = np.random.default_rng(seed)
        scene, way = random_scene(random)
        kinds += [event.what for event in EventFinder(scene).add(random_run(random, scene, way))]
    assert min(kinds.count(what) for what in ("touch", "pop", "out")) > 50


def test_a_crossing_turns_where_the_formulas_say():
    random = np.random.default_rng(1)
    for _ in range(100):
        scene, _ = random_scene(random)
        cos_beta = random.uniform(0.2, 1)
        peak, through, again, shaft = oracle.turns(scene.needle, scene.membranes[0].membrane, cos_beta)
        found = crossing(scene, 0, cos_beta)
        assert (found.peak, found.through, found.again, found.shaft) == pytest.approx(
            (peak, through, again, shaft), rel=1e-12, abs=1e-15
        )
    with pytest.raises(IndexError, match="no membrane 9"):
        crossing(scene, 9, 1.0)


def test_columns_that_do_not_fit_are_named():
    scene, _ = random_scene(np.random.default_rng(0))
    good = {"depth": np.zeros((4, 1)), "axial_force": np.zeros((4, 1)), "phase": np.zeros((4, 1), np.uint8)}
    assert EventFinder(scene).add(good) == []
    with pytest.raises(ValueError, match=r'columns\["lower"\] must have 4 rows of 1 numbers'):
        EventFinder(scene).add({**good, "lower": np.zeros((3, 1))})
    with pytest.raises(KeyError, match="phase"):
        EventFinder(scene).add({name: good[name] for name in ("depth", "axial_force")})
