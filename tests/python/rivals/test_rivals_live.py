"""Rivals on a device: felt, recorded and replayed."""

import json

import numpy as np
import punctura as pn
import pytest
from punctura._core import ForceLimits, ServoLoop, SimulatedDevice
from punctura.compare import compare, recorded_run
from punctura.events import find_events
from punctura.exercise import score
from punctura.live.run_notes import run_notes
from punctura.record import Recorder, RecordingError, open_recording, replay
from punctura.record.header import RecordingInfo
from punctura.rivals import Layer, Rival, RivalInsertion, compare_trace, save_layers
from punctura.scene import DisplaySettings
from punctura.simulation import Strokes
from punctura.studio.recorded import overview
from traces import trace
from waiting import wait_until

SCENE = pn.load_scene("k06-fig12")
WALLS = len(SCENE.membranes)
STROKES = Strokes((0, 5e-3, 0), (0, -0.02, 0), count=3, duration=0.3, rest=0.3)


def felt(path, rivals, scene=SCENE, ticks=4000, between=None):
    """A recorded run on a simulated device without a clock. Returns its ticks."""
    device = SimulatedDevice(STROKES, real_time=False, ticks=ticks)
    loop = ServoLoop(device, scene, rivals=rivals)
    listener = loop.listen(ticks)
    with Recorder(loop, path, ticks) as recorder:
        if between is not None:
            recorder.exchange(between)
        loop.arm()
        loop.start()
        wait_until(lambda: device.finished)
        loop.stop()
    return listener.read()


@pytest.mark.parametrize("name", ["okamura", "kelvin_voigt", "dahl"])
def test_a_loop_gives_the_rivals_force_and_a_replay_gives_it_again(tmp_path, name):
    rival = Rival(name, {"friction_slope": 5.0})
    ticks = felt(tmp_path / "run.parquet", [rival])
    alone = RivalInsertion(SCENE, [rival]).run(ticks.position, ticks.axis)
    assert np.array_equal(ticks.model_force, alone.force)
    assert np.abs(ticks.force).max() > 0.05
    recording = open_recording(tmp_path / "run.parquet")
    assert recording.info.rivals == [rival]
    assert recording.info.header.format == 3
    result = replay(tmp_path / "run.parquet")
    assert (result.ticks, result.identical, result.complete) == (4000, True, True)


def test_a_new_scene_keeps_the_rival_and_is_replayed_with_it(tmp_path):
    other = SCENE.with_values({"membrane[0].point[1]": -1e-3})
    ticks = felt(tmp_path / "run.parquet", [Rival("dahl")], between=other)
    assert np.array_equal(
        ticks.model_force, RivalInsertion(other, [Rival("dahl")]).run(ticks.position, ticks.axis).force
    )
    assert replay(tmp_path / "run.parquet").identical


def test_a_run_without_rivals_keeps_its_format(tmp_path):
    felt(tmp_path / "run.parquet", [], ticks=10)
    info = open_recording(tmp_path / "run.parquet").info
    assert info.rivals == []
    assert "rivals" not in info.data
    assert info.header.format == 2


def test_a_rival_that_this_version_does_not_know_is_told(tmp_path):
    felt(tmp_path / "run.parquet", [Rival("dahl")], ticks=10)
    info = open_recording(tmp_path / "run.parquet").info
    for wrong in ({"rival": "newton", "numbers": {}}, {"rival": "dahl", "numbers": {"friction": -1.0}}):
        checked = type(info.header).model_validate(info.data | {"rivals": [wrong]})
        with pytest.raises(RecordingError, match="rival in the run description is invalid"):
            _ = RecordingInfo(info.data, checked, tmp_path / "run.parquet").rivals


def test_limits_and_the_automatic_scale_act_on_a_rival(tmp_path):
    strong = Rival("dahl", {"friction": 20.0})
    limited = felt(tmp_path / "a.parquet", [strong])
    assert np.linalg.norm(limited.force, axis=1).max() <= ForceLimits().max_force + 1e-12
    assert limited["peak_limited"][-1] + limited["continuous_limited"][-1] > 0
    automatic = SCENE.replace(display=DisplaySettings("automatic"))
    scaled = felt(tmp_path / "b.parquet", [strong], automatic)
    assert scaled.force_scale[0] < 0.1
    assert overview(open_recording(tmp_path / "b.parquet")).scene.force_scale == scaled.force_scale[0]
    assert replay(tmp_path / "b.parquet").identical


def test_the_notes_name_the_rival():
    notes = run_notes(ServoLoop(SimulatedDevice(STROKES), SCENE, rivals=[Rival("dahl")]))
    assert any("the force is that of dahl" in note for note in notes)


def test_the_command_runs_a_rival_by_name_and_from_a_file(punctura, tmp_path):
    run = ["run", "k06-fig12", "--headless", "--device", "simulated", "--duration", "1", "--json"]
    file, tape = tmp_path / "fit.json", tmp_path / "run.parquet"
    save_layers(file, tuple(Layer(0.0, Rival("kelvin_voigt", {"stiffness": 300.0})) for _ in range(WALLS)))
    done = punctura(*run, "--rival", file, "--record", tape)
    assert done.status == 0, done.stderr
    assert "the force is that of kelvin_voigt" in done.stderr
    assert any("kelvin_voigt" in text for text in json.loads(done.stdout)["statements"])
    assert open_recording(tape).info.rivals[0].numbers["stiffness"] == 300.0
    assert punctura("replay", tape).status == 0
    done = punctura(*run[:-3], "--duration", "0.1", "--rival", "okamura")
    assert "the force is that of okamura" in done.stderr and "okamura" not in done.stdout  # a note, once on a terminal


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        (["--headless", "--rival", "newton"], "must be one of"),
        (["--headless", "--rival", "kelvin-voight"], "sign_of_velocity; did you mean kelvin_voigt?"),
        (["--headless", "--rival", ""], "rival = '': must be one of okamura"),
        (["--headless", "--rival", "dahl", "--rival", "okamura"], "is given 2 times: a run has the force of one model"),
        (["--headless", "--rival", "fits/dahl.json"], "there is no such file"),
        (["--headless", "--rival", __file__], "is no JSON, as punctura rivals --out writes it"),
        (["--rival", "dahl"], "needs --headless"),
    ],
)
def test_a_wrong_rival_is_refused_before_the_run(punctura, wrong, why):
    done = punctura("run", "k06-fig12", "--device", "simulated", *wrong)
    assert done.status == 2
    assert why in " ".join(done.stderr.replace("│", " ").split())


def test_a_rivals_recording_has_no_pops_of_the_scenes_law_and_no_score(tmp_path):
    felt(tmp_path / "run.parquet", [Rival("kelvin_voigt")])
    recording = open_recording(tmp_path / "run.parquet")
    with pytest.warns(UserWarning, match="the force is that of kelvin_voigt, and pops follow from the scene's law"):
        events = find_events(recording)
    assert {event.what for event in events} == {"touch", "out"}
    assert {event.what for event in overview(recording).events} == {"touch", "out"}
    run = recorded_run(recording)
    (numbers,) = compare([run]).statistics
    assert numbers.name == "run (kelvin_voigt)" and numbers.pops == [] and numbers.drop is None
    with pytest.raises(RecordingError, match="the force is that of kelvin_voigt: an exercise judges"):
        score(recording.path, "venipuncture")
    felt(tmp_path / "own.parquet", [])
    own = open_recording(tmp_path / "own.parquet")
    assert "pop" in {event.what for event in find_events(own)}
    assert compare([recorded_run(own)]).statistics[0].drop > 0


def test_a_misspelt_model_to_compare_is_answered_with_a_near_one():
    with pytest.raises(pn.ConfigurationError, match="did you mean kelvin_voigt"):
        compare_trace(trace(), ["kelvin-voight"])
