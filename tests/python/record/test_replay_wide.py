"""A run with measured tissue, a relaxing coupling and sub-steps is recorded and replayed bit for bit."""

import json

import numpy as np
from punctura import MaxwellBranch, Tissue, load_scene
from punctura.record import open_recording, replay
from punctura.scene.build import scene_text
from punctura.studio.loaded import from_tables, from_text


def wide_scene():
    scene = load_scene("k06-fig12")
    wall, profile = scene.membranes
    wall = wall.replace(
        tissue=Tissue("exponential", 500.0, tip_length=3e-3, tail_length=1e-3, tail_floor=0.4, cutting=0.2)
    )
    profile = profile.replace(tissue=Tissue(profile=[(0, 0, 0), (1.5e-3, -0.5, 0.05), (4e-3, -0.2, 0.1)], set=0.3))
    return scene.replace(
        membranes=[wall, profile],
        relaxation=[MaxwellBranch(100, 0.2), MaxwellBranch(40, 2)],
        servo=scene.servo.replace(sub_steps=3, conditioning="line_fit"),
    )


def test_a_recording_has_the_scene_and_replays_it(start):
    scene = wide_scene()
    run = start(ticks=8000, scene=scene)
    run.record()
    recording = open_recording(run.path)
    assert recording.info.scene.membranes == scene.membranes and recording.info.scene.relaxation == scene.relaxation
    result = replay(run.path)
    assert (result.ticks, result.identical, result.complete) == (8000, True, True)
    assert np.abs(recording.column("fy_N")).max() > 0.1


def test_a_change_between_plain_and_wide_replays(start):
    plain, wide = load_scene("k06-fig12"), wide_scene()
    run = start(ticks=6000, scene=plain, capacity=100_000)  # four runs without a clock, two in larger snapshots
    run.go()
    for scene in (wide, plain, wide):
        run.recorder.exchange(scene.replace(servo=plain.servo))
        run.go()
    run.recorder.finish()
    result = replay(run.path)
    assert (result.identical, result.complete) == (True, True), result.notes


def test_the_editor_gets_the_tables_and_gives_them_back():
    loaded = from_text(scene_text(wide_scene()))
    tables = json.loads(json.dumps(loaded.file.model_dump(mode="json", exclude_none=True)))
    assert tables["membrane"][1]["profile_depth_mm"] == [0.0, 1.5, 4.0]
    tables["membrane"][1]["profile_lower_N"][1] = -0.75
    assert from_tables(tables).scene.membranes[1].tissue.profile[1] == (1.5e-3, -0.75, 0.05)
