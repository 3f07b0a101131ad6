"""simulate() on a motion in memory."""

import numpy as np
import pyarrow.parquet
import pytest
from punctura import Insertion, load_scene, simulate

from .simulate_motions import AXIS_HEADER, HEADER, rows_of, strokes

SCENE = load_scene("k06-fig12")


def test_it_gives_what_the_file_gives(write, tmp_path):
    time, position = strokes(3000)
    simulate(SCENE, write([HEADER, *rows_of(time, position)]), tmp_path / "out.parquet")
    file = pyarrow.parquet.read_table(tmp_path / "out.parquet")
    arrays = simulate("k06-fig12", position, time=time).to_arrow().select(file.column_names)
    assert all(a.equals(b) for a, b in zip(arrays.columns, file.columns, strict=True))


def test_a_motion_at_another_rate_is_resampled_as_a_file_is(write, tmp_path):
    time, position = strokes(1500)
    time = time * 3.2  # 500 Hz
    axis = np.column_stack((0.2 + time, np.full(1500, -2.0), np.zeros(1500)))
    simulate(SCENE, write([AXIS_HEADER, *rows_of(time, position, axis)]), tmp_path / "out.parquet")
    file = pyarrow.parquet.read_table(tmp_path / "out.parquet")
    arrays = simulate(SCENE, position, time=time, axis=axis)
    assert len(arrays) == len(file) > 4000
    assert np.array_equal(arrays.time, file["time_s"]) and np.array_equal(arrays.force[:, 1], file["fy_N"])


def test_depths_go_along_the_normal_of_the_first_membrane():
    depths = np.linspace(-1e-3, 9e-3, 2000)
    ticks = simulate(SCENE, depths)
    position = depths[:, None] * np.array([0.0, -1.0, 0.0])
    assert np.array_equal(ticks.force, Insertion(SCENE).run(position, [0, -1, 0]).force)
    assert np.array_equal(ticks.tick, np.arange(2000)) and ticks.time[-1] == 1999 / 1600
    assert ticks.membranes == ("first membrane", "second membrane")


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (
            {"motion": np.zeros((5, 2))},
            r"position must have shape \(n, 3\), m, or \(n,\), depths in m, not \(5, 2\)",
        ),
        (
            {"motion": np.zeros(5), "time": np.arange(4)},
            r"time must have shape \(5,\), one for each position, not \(4,\)",
        ),
        ({"motion": np.zeros(5), "time": [0, 0.001, 0.002, 0.002, 0.004]}, r"time\[3\]: .*stays at 0.002"),
        ({"motion": np.zeros(3), "time": [0, np.nan, 1]}, r"time\[1\] is not a finite number"),
        ({"motion": np.zeros(3), "time": [0, 1000, 2000]}, "grows by 1000 s from row to row"),
        ({"motion": np.zeros(4), "axis": np.zeros((2, 3))}, r"axis must have shape \(3,\) or \(4, 3\), not \(2, 3\)"),
        ({"motion": np.zeros(4), "axis": [0, 0, 0]}, r"axis\[0\] must be a direction"),
        ({"motion": [0.0, np.nan]}, r"position\[1\] must be finite"),
    ],
)
def test_a_motion_that_cannot_be_used_says_why(arguments, says):
    with pytest.raises(ValueError, match=says):
        simulate(SCENE, arguments.pop("motion"), **arguments)


def test_a_file_and_an_array_take_different_arguments(write):
    with pytest.raises(TypeError, match="save"):
        simulate(SCENE, np.zeros(5), "out.csv")
    with pytest.raises(TypeError, match="or time="):
        simulate(SCENE, np.zeros((5, 3)), (0, -1, 0))
    with pytest.raises(TypeError, match="a scene is a file or the name of a ready scene, not int"):
        simulate(3, "motion.csv", "out.csv")
    with pytest.raises(TypeError, match="motion file has columns"):
        simulate(SCENE, "motion.csv", "out.csv", axis=[0, -1, 0])
    with pytest.raises(TypeError, match="needs out_path"):
        simulate(SCENE, "motion.csv")


@pytest.mark.filterwarnings("error")
def test_depths_in_millimetres_give_a_warning_and_those_in_metres_none():
    depths = np.linspace(-5e-3, 11e-3, 500)
    simulate(SCENE, depths)
    simulate(SCENE, depths[:0])
    with pytest.warns(UserWarning, match=r"11 m deep into 'first membrane'.*in millimetres, divide") as warned:
        ticks = simulate(SCENE, 1e3 * depths)
    assert len(ticks) == 500 and warned[0].filename == __file__
