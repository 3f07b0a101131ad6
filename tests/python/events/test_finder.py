"""The event finder finds each event once, for any split of the ticks into batches."""

import copy
import pickle

import numpy as np
import punctura as pn
import pytest
from punctura.events import EventFinder
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


def test_a_needle_in_and_out_gives_each_event_once():
    events = found(STILL, along(STILL, ramp(STILL, -2e-3, 15e-3, -2e-3)))
    assert brief(events) == [
        ("touch", 0), ("touch", 1), ("pop", 0), ("pop", 1), ("out", 1), ("out", 0),
    ]  # fmt: skip
    assert [event.tick for event in events] == sorted(event.tick for event in events)
    assert [event.name for event in events[:2]] == ["first membrane", "second membrane"]
    assert all(event.force_before == event.drop == 0 for event in events if event.what != "pop")


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
