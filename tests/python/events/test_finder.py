"""The event finder finds each event once, for any split of the ticks into batches."""

import copy
import itertools
import pickle

import numpy as np
import punctura as pn
import pytest
from punctura import Phase
from punctura.events import EventFinder, crossing
from punctura.scene import ServoSettings
from runs import along, cut, moved, ramp, unit

SCENE = pn.load_scene("k06-fig12")
STILL = SCENE.replace(servo=SCENE.servo.replace(low_pass=0))


def found(scene, columns):
    return EventFinder(scene).add(columns)


def brief(events):
    return [(event.what, event.membrane) for event in events]


def restless(scene, seed):
    """Random insertions and withdrawals with a tremor, at an angle."""
    random = np.random.default_rng(seed)
    depths = np.concatenate([[-2e-3], random.uniform(-1e-3, 20e-3, 14), [-3e-3]])
    path = ramp(scene, *depths, speed=40e-3)
    axis = unit((0.3, -1, 0.1))
    position = np.outer(path, axis) + 3e-5 * random.standard_normal((len(path), 3))
    return moved(scene, position, axis)


@pytest.mark.parametrize("name", ["k06-fig12", "k06-fig10", "venipuncture"])
@pytest.mark.parametrize("solver", ["exact", "paper"])
def test_events_do_not_depend_on_the_batches(name, solver):
    scene = pn.load_scene(name)
    scene = scene.replace(servo=scene.servo.replace(solver=solver))
    random = np.random.default_rng(2)
    for seed in range(4):
        columns = restless(scene, seed)
        whole = found(scene, columns)
        assert len(whole) > 5
        for _ in range(5):
            finder = EventFinder(scene)
            places = random.integers(0, len(columns["tick"]), random.integers(1, 400))
            assert [e for batch in cut(columns, places) for e in finder.add(batch)] == whole
    near = whole[5].tick
    finder = EventFinder(scene)
    pieces = cut(columns, range(near - 20, near + 20))
    assert [e for batch in pieces for e in finder.add(batch)] == whole


@pytest.mark.parametrize("seed", range(5))
def test_events_of_a_membrane_come_in_a_possible_order(seed):
    """First touch, then pops with a return between them, then out."""
    scene = STILL
    columns = restless(scene, 10 + seed)
    for i in range(len(scene.membranes)):
        events = [event for event in found(scene, columns) if event.membrane == i]
        inside = False
        for event in events:
            assert (event.what == "touch") != inside
            inside = event.what != "out"
        depth, again = columns["depth"][:, i], crossing(scene, i, unit((0.3, -1, 0.1)) @ (0, -1, 0)).again
        for one, other in itertools.pairwise(events):
            if one.what == other.what == "pop":
                assert depth[one.tick : other.tick].min() <= again


def test_a_needle_in_and_out_gives_each_event_once():
    events = found(STILL, along(STILL, ramp(STILL, -2e-3, 15e-3, -2e-3)))
    assert brief(events) == [
        ("touch", 0), ("touch", 1), ("pop", 0), ("pop", 1), ("out", 1), ("out", 0),
    ]  # fmt: skip
    assert [event.tick for event in events] == sorted(event.tick for event in events)
    assert [event.name for event in events[:2]] == ["first membrane", "second membrane"]
    assert all(event.force_before == event.drop == 0 for event in events if event.what != "pop")


def test_a_second_entry_gives_them_all_again():
    once = found(STILL, along(STILL, ramp(STILL, -2e-3, 15e-3, -2e-3)))
    twice = found(STILL, along(STILL, ramp(STILL, -2e-3, 15e-3, -2e-3, 15e-3, -2e-3)))
    assert brief(twice) == 2 * brief(once)
    assert [event.drop for event in twice] == pytest.approx(2 * [event.drop for event in once], rel=2e-3)


@pytest.mark.parametrize(("back", "pops"), [(0.3e-3, 1), (1.5e-3, 1), (3e-3, 2), (5e-3, 2)])
def test_a_pop_counts_again_once_the_tip_has_come_back_before_the_peak(back, pops):
    scene = pn.load_scene("k06-fig11").replace(servo=ServoSettings(low_pass=0))
    turns = crossing(scene, 0, 1.0)
    assert turns.through - turns.again > 2e-3
    deep = turns.through + 2e-3  # depth of the tip; the proxy lags by the stretch of the coupling
    columns = along(scene, ramp(scene, -1e-3, deep, turns.through - back, deep, turns.through - back, deep))
    shallowest = columns["depth"][len(columns["tick"]) // 2 :, 0].min()
    events = found(scene, columns)
    assert sum(event.what == "pop" for event in events) == (3 if shallowest <= turns.again else 1)


def test_a_tip_that_trembles_at_the_surface_touches_once():
    random = np.random.default_rng(3)
    n = 8000
    position = 3e-5 * random.standard_normal((n, 3))
    position[:800] += (0, 1e-3, 0)
    events = found(STILL, moved(STILL, position, np.array([0.0, -1.0, 0.0])))
    assert brief(events) == [("touch", 0)]


def test_a_needle_that_starts_inside_has_touched_nothing():
    alone = STILL.replace(membranes=STILL.membranes[:1])
    assert found(alone, along(alone, ramp(alone, 1e-3, 12e-3, 1e-3))) == []
    events = found(STILL, along(STILL, ramp(STILL, 1e-3, -2e-3, 15e-3)))
    assert brief(events) == [("touch", 0), ("touch", 1), ("pop", 0), ("pop", 1)]


def test_a_grazing_needle_gives_no_event():
    angle = np.radians(85)
    assert found(STILL, along(STILL, ramp(STILL, -1e-3, 40e-3), (np.sin(angle), -np.cos(angle), 0))) == []


def test_ticks_without_numbers_are_passed_over():
    columns = along(STILL, ramp(STILL, -2e-3, 15e-3, -2e-3))
    whole = found(STILL, columns)
    holes = np.random.default_rng(4).random(columns["depth"].shape) < 0.2
    for event in whole:
        holes[event.tick, event.membrane] = False
    torn = {name: column.copy() for name, column in columns.items()}
    for name in ("depth", "axial_force", "lower", "upper"):
        torn[name][holes] = np.nan
    torn["phase"][holes] = 255
    events = found(STILL, torn)
    assert brief(events) == brief(whole)
    assert [event.tick for event in events] == [event.tick for event in whole]
    blind = {**torn, "lower": np.full_like(columns["lower"], np.nan)}
    blind["axial_force"] = np.where(
        np.isin(columns["tick"], [e.tick for e in whole])[:, None], np.nan, torn["axial_force"]
    )
    pops = [event for event in found(STILL, blind) if event.what == "pop"]
    assert [event.force_after for event in pops] == pytest.approx([0.41024, 0.41024])
    nothing = {**torn, "depth": np.full_like(columns["depth"], np.nan)}
    assert found(STILL, nothing) == []


def test_a_membrane_that_becomes_barred_is_left_once_and_does_not_pop():
    columns = along(STILL, ramp(STILL, -2e-3, 15e-3, -2e-3))
    whole = found(STILL, columns)
    barred = columns["phase"].copy()
    first = whole[1].tick + 10
    barred[first:][barred[first:] != Phase.outside.value] = Phase.barred.value
    assert brief(found(STILL, {**columns, "phase": barred})) == [("touch", 0), ("touch", 1), ("out", 1), ("out", 0)]


def test_columns_of_more_or_fewer_membranes_than_the_scene_has_do_no_harm():
    columns = along(STILL, ramp(STILL, -2e-3, 15e-3))
    alone = STILL.replace(membranes=STILL.membranes[:1])
    assert brief(found(alone, columns)) == [("touch", 0), ("pop", 0)]
    few = {k: v[:, :1] if v.ndim == 2 and v.shape[1] == 2 else v for k, v in columns.items()}
    assert brief(found(STILL, few)) == [("touch", 0), ("pop", 0)]
    assert EventFinder(STILL).add({k: v[:0] for k, v in columns.items()}) == []


def test_without_columns_tick_and_time_the_rate_gives_them():
    columns = along(STILL, ramp(STILL, -2e-3, 15e-3))
    bare = {name: columns[name] for name in ("depth", "axial_force", "phase")}
    assert [e.model_copy(update={"force_after": 0, "drop": 0}) for e in found(STILL, bare)] == [
        e.model_copy(update={"force_after": 0, "drop": 0}) for e in found(STILL, columns)
    ]


def test_without_a_column_tick_the_ticks_are_counted_over_all_batches():
    columns = along(STILL, ramp(STILL, -2e-3, 15e-3))
    bare = {name: columns[name] for name in ("depth", "axial_force", "phase", "lower")}
    finder = EventFinder(STILL)
    events = [event for batch in cut(bare, range(0, 4000, 100)) for event in finder.add(batch)]
    assert events == found(STILL, columns)


def test_a_changed_membrane_pops_where_its_new_law_says():
    thick = STILL.replace(membranes=[p.replace(membrane=p.membrane.replace(thickness=3e-3)) for p in STILL.membranes])
    columns = along(STILL, ramp(STILL, -2e-3, 3e-3))
    finder = EventFinder(STILL)
    assert brief(finder.add(columns)) == [("touch", 0)]
    finder.change(thick)
    later = along(thick, ramp(thick, -2e-3, 15e-3))
    keep = later["depth"][:, 0] > columns["depth"][-1, 0]
    later = {name: column[keep] for name, column in later.items()}
    later["commands"] = np.zeros(len(later["tick"]), dtype=np.uint32)
    later["commands"][5] = 8
    pop = next(event for event in finder.add(later) if event.what == "pop")
    assert pop.depth == pytest.approx(crossing(thick, 0, 1.0).through, abs=5e-5)
    moved_away = STILL.replace(membranes=[p.replace(point=(0, -1e-3, 0)) for p in STILL.membranes])
    finder.change(moved_away)
    assert finder.add({name: column[-1:] for name, column in columns.items()})[0].what == "touch"


def test_an_event_without_a_time_is_refused_and_the_batch_is_not_taken():
    path = np.outer(np.linspace(-1e-3, 12e-3, 400), [0, -1, 0])
    ticks = pn.Insertion(SCENE).run(path, [0, -1, 0])
    time = np.arange(400) / 1600
    finder, other = EventFinder(SCENE), EventFinder(SCENE)
    with pytest.raises(ValueError, match="time must be finite where an event is found"):
        finder.add(ticks.replace(time=np.full(400, np.nan)))
    good = ticks.replace(time=time)
    assert finder.add(good) == other.add(good) != []


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda finder: pickle.loads(pickle.dumps(finder))])
def test_a_copied_or_pickled_finder_continues_with_the_same_events(copied):
    columns = restless(STILL, 3)
    whole = found(STILL, columns)
    for at in (whole[0].tick + 1, whole[2].tick, whole[4].tick + 1):
        head, tail = cut(columns, [at])
        first = EventFinder(STILL)
        before = first.add(head)
        second = copied(first)
        assert before + first.add(tail) == before + second.add(tail) == whole


def test_a_pickled_finder_keeps_the_scene_that_waits_for_its_tick():
    thick = STILL.with_values({"membrane[0].thickness": 2 * STILL.membranes[0].membrane.thickness})
    run = dict(along(STILL, ramp(STILL, -2e-3, 15e-3)))
    run.pop("commands", None)  # so that the first tick takes the scene
    finder = EventFinder(STILL)
    finder.change(thick)
    again = pickle.loads(pickle.dumps(finder))
    assert again.add(run) == finder.add(run) == found(thick, run)
    assert found(thick, run) != found(STILL, run)
