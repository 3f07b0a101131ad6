"""Compares the events of a live run with those of its recording."""

import numpy as np
import punctura as pn
import pytest
from punctura._core import ServoLoop, SimulatedDevice
from punctura.events import EventFinder, find_events
from punctura.record import Recorder, open_recording
from punctura.record.columns import ticks_of
from punctura.simulation import Strokes
from waiting import wait_until

STROKES = Strokes((0, 5e-3, 0), (0, -0.02, 0), count=100, duration=0.3, rest=0.1)


def record(path, scene, ticks, exchange=None):
    """Runs a loop and returns the batches that a listener read."""
    device = SimulatedDevice(STROKES, real_time=False, ticks=ticks)
    loop = ServoLoop(device, scene)
    listener = loop.listen(ticks)
    recorder = Recorder(loop, path, ticks)
    loop.arm()
    if exchange:
        recorder.exchange(exchange)
    loop.start()
    wait_until(lambda: device.finished)
    loop.stop()
    recorder.finish()
    batches = []
    while len((columns := listener.read(777))["tick"]):
        batches.append(columns)
    return batches


def test_ticks_in_memory_have_events_too():
    scene = pn.load_scene("k06-fig12")
    ticks = pn.simulate(scene, np.linspace(-1e-3, 20e-3, 4000))
    assert [event.what for event in find_events(ticks, scene)] == ["touch", "touch", "pop", "pop"]
    with pytest.raises(TypeError, match=r"find_events\(ticks, scene\)"):
        find_events(ticks)
    with pytest.raises(ValueError, match="rate must be greater than 0 Hz, not -5"):
        EventFinder(scene, -5)


def test_a_recordings_events_are_those_of_the_live_run(tmp_path):
    scene = pn.load_scene("k06-fig12")
    batches = record(tmp_path / "run.parquet", scene, 6000)
    finder = EventFinder(scene, 1600)
    live = [event for batch in batches for event in finder.add(batch)]
    assert {event.what for event in live} == {"touch", "pop", "out"}
    assert find_events(open_recording(tmp_path / "run.parquet")) == live


def test_a_recordings_columns_are_those_that_a_listener_gave(tmp_path):
    scene = pn.load_scene("k06-fig12")
    batches = record(tmp_path / "run.parquet", scene, 2000)
    read = [ticks_of(batch) for batch in open_recording(tmp_path / "run.parquet").batches()]
    for name in read[0]:
        if name == "lost":
            continue
        one = np.concatenate([columns[name] for columns in read])
        other = np.concatenate([columns[name] for columns in batches])
        assert np.array_equal(one, other, equal_nan=one.dtype.kind == "f"), name


def test_a_scene_that_was_changed_is_taken_from_the_recording(tmp_path):
    scene = pn.load_scene("k06-fig12")
    thick = scene.replace(membranes=[p.replace(membrane=p.membrane.replace(thickness=2e-3)) for p in scene.membranes])
    batches = record(tmp_path / "run.parquet", scene, 3000, exchange=thick)
    finder = EventFinder(scene, 1600)
    finder.change(thick)
    live = [event for batch in batches for event in finder.add(batch)]
    recording = open_recording(tmp_path / "run.parquet")
    assert find_events(recording) == live
    pops = [event for event in live if event.what == "pop"]
    assert pops
    wrong = [event for event in find_events(recording, recording.info.scene) if event.what == "pop"]
    law = pn.ThickLaw(scene.needle, thick.membranes[0].membrane)
    assert all(event.depth >= law.X + law.U for event in pops)
    assert pops == wrong  # the file's own scenes count, whatever it began with


def test_events_of_a_whole_recording_need_no_more_than_a_listener_gives(tmp_path):
    scene = pn.load_scene("epidural")
    record(tmp_path / "run.parquet", scene, 4000)
    events = find_events(open_recording(tmp_path / "run.parquet"))
    assert [event.tick for event in events] == sorted(event.tick for event in events)
    assert events[0].name == "skin"
    with pytest.raises(ValueError, match="no such file"):
        find_events(open_recording(tmp_path / "none.parquet"))
