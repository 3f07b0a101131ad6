"""Every class that a user can get hold of says what it is: no <punctura._core.Proxy1d object at 0x7f...>."""

import io

import numpy as np
import punctura
import pytest
from exported import exported
from punctura import _core
from punctura.events import EventFinder
from punctura.exercise import Attempt, ResultStore, load_exercise
from punctura.live import DroppingStream, FedDevice, Pacer, ReplayDevice, ServoLoop, SimulatedDevice
from punctura.record import Recorder, open_recording
from punctura.simulation import Experiment, RecordedMotion, Strokes, Target

SCENE = punctura.load_scene("k06-fig10")
WALL = SCENE.membranes[0].membrane
AXIS = [0.0, -1.0, 0.0]


def test_no_exported_class_has_the_default_repr():
    mute = {
        name
        for name, thing in exported().items()
        if thing.__repr__ is object.__repr__ and not getattr(thing, "_is_protocol", False)
    }
    assert len(exported()) > 60 and mute == set()


@pytest.fixture
def loop():
    device = SimulatedDevice(Target([0, 0.01, 0]), real_time=False, ticks=100)
    with ServoLoop(device, SCENE) as loop:
        yield loop


MADE = [
    (
        punctura.Proxy1d(punctura.ThinLaw(SCENE.needle, WALL), SCENE.coupling, 1e-3),
        "<Proxy1d sticking: depth 0 m, force 0 N>",
    ),
    (
        punctura.Proxy3d(SCENE.needle, WALL, [0, 0, 0], AXIS, SCENE.coupling, 1e-3),
        "<Proxy3d barred: depth 0 m, force [0.0, 0.0, 0.0] N>",
    ),
    (
        punctura.Insertion(SCENE),
        f"<Insertion in {SCENE.name!r}: tip [0.0, 0.0, 0.0] m, force [0.0, 0.0, 0.0] N>",
    ),
    (Experiment(SCENE, Target([0, 0, 0])), f"<Experiment in {SCENE.name!r}: 0 ticks>"),
    (
        Strokes([0, 0, 0], (0, -0.01, 0)),
        "Strokes(start=(0.0, 0.0, 0.0), end=(0.0, -0.01, 0.0), count=3, duration=1.5, rest=0.6, variation=0.1)",
    ),
    (RecordedMotion([0, 0.5], np.zeros((2, 3))), "<RecordedMotion of 0.5 s>"),
    (Target([0, 0.01, 0]), "<Target at [0.0, 0.01, 0.0] m>"),
    (FedDevice(500), "<FedDevice '' at 500 Hz>"),
    (ReplayDevice(np.zeros((4, 3)), AXIS, 1000), "<ReplayDevice 'a recorded motion' at 1000 Hz>"),
    (Pacer(500), "<Pacer at 500 Hz>"),
    (EventFinder(SCENE), "<EventFinder at 1600 Hz>"),
    (_core.Replay(SCENE, _core.GateLimits(), _core.ForceLimits()), "<Replay at 1600 Hz>"),
    (_core.TickArrays({"time": 1}), "TickArrays({'time': 1})"),
    (ResultStore("results"), "ResultStore('results')"),
]


@pytest.mark.parametrize(("thing", "says"), MADE, ids=[type(thing).__name__ for thing, _ in MADE])
def test_a_repr_says_what_a_thing_is_and_how_it_stands(thing, says):
    assert repr(thing) == says


def test_what_device_info_prints_can_be_read_back():
    info = _core.DeviceInfo(model="own", rate=500, **dict.fromkeys(("max_force", "continuous_force"), 1.0))
    assert repr(eval(repr(info), {"DeviceInfo": _core.DeviceInfo, "nan": float("nan")})) == repr(info)


def test_a_loop_says_whether_it_runs_and_how_many_ticks_it_made(loop, tmp_path):
    assert repr(loop) == f"<ServoLoop of {SCENE.name!r} on {loop.device!r}: running=False, 0 ticks>"
    listener = loop.listen(100)
    with Recorder(loop, tmp_path / "run.parquet") as recorder:
        assert repr(recorder).startswith(f"<Recorder of {str(tmp_path / 'run.parquet')!r}: RecorderStatus(")
        loop.start()
        while not loop.device.finished:
            pass
        loop.stop()
    assert repr(loop).endswith("running=False, 100 ticks>")
    assert repr(listener) == f"<Listener with room for {listener.capacity} ticks, 0 lost>"
    recording = open_recording(tmp_path / "run.parquet")
    assert repr(recording) == f"<Recording {str(recording.path)!r}: 100 ticks, 0 lost, finished=True>"


def test_an_attempt_and_a_stream_say_what_they_are_of(tmp_path):
    exercise = load_exercise("venipuncture")
    attempt = Attempt(exercise, exercise.scene)
    assert repr(attempt) == f"<Attempt at {exercise.file.title!r}: 0 ticks, over=False>"
    stream = io.TextIOWrapper(io.FileIO(tmp_path / "out", "w"))
    assert repr(DroppingStream(stream)) == f"<DroppingStream to {stream!r}: 0 lines dropped>"
