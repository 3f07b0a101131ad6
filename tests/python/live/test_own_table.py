"""A law that is a table in Python is felt on a device, recorded, replayed, and run again from its scene file."""

import numpy as np
import punctura as pn
from punctura.live import Limit, ServoState, SimulatedDevice
from punctura.record import open_recording, replay
from punctura.scene.build import scene_text
from punctura.simulation import Strokes
from recorded import recorded

DEPTH = np.linspace(0, 6e-3, 32)  # m
RESISTS = 0.9 * np.sin(DEPTH / 6e-3 * 2.5) ** 2  # N, while the needle goes in
HOLDS = 0.1 + 20 * DEPTH  # N, while it comes out
STROKES = Strokes((0, 5e-3, 0), (0, -8e-3, 0), count=2, duration=0.5, rest=0.3)
TICKS = 4000


def scene():
    """One wall without thickness: its force is the table's."""
    base = pn.load_scene("k06-fig12")
    wall = base.membranes[0]
    table = pn.Tissue(profile=np.column_stack([DEPTH, -RESISTS, HOLDS]))
    return base.replace(membranes=[wall.replace(membrane=wall.membrane.replace(thickness=0.0), tissue=table)])


def assert_it_is_the_table(ticks):
    depth, force, phase = ticks.depth[:, 0], ticks.axial_force[:, 0], ticks.phase[:, 0]
    for sliding, law in ((pn.Phase.sliding_in, -RESISTS), (pn.Phase.sliding_out, HOLDS)):
        now = phase == sliding
        assert now.sum() > 200 and np.ptp(depth[now]) > 5e-3
        np.testing.assert_allclose(force[now], np.interp(depth[now], DEPTH, law), atol=1e-9)
    free = (ticks.limit == Limit.none) & (ticks.state == ServoState.active)
    assert np.abs(ticks.force[free, 1]).max() > 0.5
    np.testing.assert_array_equal(ticks.force[free], ticks.model_force[free])


def test_a_table_is_felt_and_replayed(tmp_path):
    path = recorded(tmp_path / "run.parquet", SimulatedDevice(STROKES, real_time=False, ticks=TICKS), scene(), TICKS)
    assert_it_is_the_table(open_recording(path).ticks())
    result = replay(path)
    assert (result.ticks, result.identical, result.complete) == (TICKS, True, True)


def test_the_command_runs_the_scene_file_of_a_table(punctura, tmp_path):
    file, tape = tmp_path / "table.toml", tmp_path / "run.parquet"
    file.write_text(scene_text(scene()))
    done = punctura("run", file, "--headless", "--device", "simulated", "--duration", "0.1", "--record", tape)
    assert done.status == 0, done.stderr
    assert open_recording(tape).info.scene.membranes == scene().membranes
