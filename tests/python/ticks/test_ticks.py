"""Ticks, the result of every run."""

import pickle
import subprocess
import sys
import types

import numpy as np
import pandas
import punctura as pn
import pyarrow.csv
import pyarrow.parquet
import pytest
from punctura.simulation import Experiment, Strokes
from punctura.ticks import ABSENT, FIELDS, Ticks
from punctura.ticks.fields import file_column, file_columns, flatten, gather

SCENE = pn.load_scene("k06-fig12")
DOWN = np.array([0.0, -1.0, 0.0])
DEPTHS = np.linspace(-1e-3, 9e-3, 800)
NEEDLE, WALL, COUPLING = pn.Needle(1.08e-3, 0.28), pn.Membrane(570, 0.41, 0.2, 1e-4), pn.Coupling(400, 1)


def on_a_line():
    return pn.Proxy1d(pn.ThickLaw(NEEDLE, WALL), COUPLING, 1 / 1600).run(DEPTHS)


def in_space():
    return pn.Proxy3d(NEEDLE, WALL, [0, 0, 0], DOWN, COUPLING, 1 / 1600).run(DEPTHS[:, None] * DOWN, DOWN)


def insertion():
    return pn.Insertion(SCENE).run(DEPTHS[:, None] * DOWN, DOWN)


def experiment():
    return Experiment(SCENE, Strokes([0, 5e-3, 0], [0, -10e-3, 0]), seed=1).run(1.0)


def simulated():
    return pn.simulate(SCENE, DEPTHS)


MAKERS = [on_a_line, in_space, insertion, experiment, simulated]


def same(one: Ticks, other: Ticks):
    assert list(one) == list(other)
    for name, column in one.items():
        assert column.dtype == other[name].dtype and np.array_equal(
            column, other[name], equal_nan=column.dtype.kind == "f"
        )


@pytest.mark.parametrize("make", MAKERS)
def test_all_ticks_have_one_row_a_tick_and_the_types_of_the_table(make):
    ticks = make()
    assert len(ticks) in (800, 1600) and set(ticks) <= set(FIELDS)
    for name, column in ticks.items():
        assert len(column) == len(ticks) and column.dtype == FIELDS[name].dtype, name
        assert getattr(ticks, name) is column
    assert repr(ticks).startswith(f"Ticks({len(ticks)} ticks: ")


def test_an_experiment_has_every_field_of_the_table():
    assert list(experiment()) == list(FIELDS)


def test_shapes_say_how_many_membranes_and_components_there_are():
    assert {c.shape for c in on_a_line().columns.values()} == {(800,)}
    space, walls = in_space(), insertion()
    assert space.force.shape == space.proxy.shape == (800, 3) and space.depth.shape == (800,)
    assert walls.depth.shape == (800, 2) and walls.proxy.shape == (800, 2, 3)
    assert [ticks.membrane_count for ticks in (on_a_line(), space, walls)] == [1, 1, 2]


@pytest.mark.parametrize("make", MAKERS)
def test_the_columns_of_a_file_give_the_ticks_back(make):
    ticks = make()
    again = gather(flatten(ticks))
    for name, column in ticks.items():
        assert np.array_equal(again[name].reshape(column.shape), column, equal_nan=column.dtype.kind == "f"), name


def test_every_column_of_a_file_is_known_by_its_name():
    for column in file_columns(list(FIELDS.values()), 12):
        assert file_column(column.name) == column
    assert file_column("depth_front_m") is None and file_column("lost") is None


def test_a_slice_a_mask_and_places_give_ticks_and_a_name_gives_the_column():
    ticks = simulated()
    same(ticks[100:200], ticks[np.arange(100, 200)])
    assert len(ticks[ticks.phase[:, 0] == pn.Phase.outside.value]) == int((ticks["phase"][:, 0] == 0).sum())
    assert ticks[5:6].membranes == ticks.membranes == tuple(p.name for p in SCENE.membranes)


def test_a_missing_field_says_which_ones_there_are():
    ticks = on_a_line()
    with pytest.raises(AttributeError, match="these ticks have no ceiling; they have position, force"):
        _ = ticks.ceiling
    with pytest.raises(KeyError, match="these ticks have position, force"):
        _ = ticks["ceiling"]
    with pytest.raises(TypeError, match=r"ticks\[3:4\]"):
        _ = ticks[3]
    with pytest.raises(TypeError, match=r"ticks\[-1:\]"):
        _ = ticks[-1]
    with pytest.raises(ValueError, match="force 3, depth 2"):
        Ticks({"force": np.zeros((3, 3)), "depth": np.zeros((2, 1))})


def test_a_pickle_comes_back_whole():
    ticks = simulated()
    again = pickle.loads(pickle.dumps(ticks))
    same(ticks, again)
    assert again.membranes == ticks.membranes


def test_a_fault_is_told_in_words():
    assert experiment().fault_text == ""
    assert "reset" in Ticks({"fault": np.array([0, 1], np.uint8)}).fault_text


def test_pandas_gets_numbers_and_words():
    ticks = simulated()
    frame = ticks.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame) == list(flatten(ticks))
    assert np.array_equal(frame["force_1_N"], ticks.axial_force[:, 1])
    assert list(frame["phase_0"]) == [pn.Phase(int(code)).name for code in ticks.phase[:, 0]]


def test_polars_gets_the_arrow_table(monkeypatch):
    """Replaces the package, which is large, by a module that stores its arguments. The tested call is one line."""
    polars = types.ModuleType("polars")
    polars.DataFrame = type("DataFrame", (), {})
    given = []
    polars.from_arrow = lambda table: given.append(table) or polars.DataFrame()
    monkeypatch.setitem(sys.modules, "polars", polars)
    ticks = simulated()
    assert isinstance(ticks.to_polars(), polars.DataFrame) and given == [ticks.to_arrow()]


@pytest.mark.parametrize("package", ["pandas", "polars"])
def test_without_the_package_of_a_frame_it_is_said_how_to_install_it(monkeypatch, package):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(
        ModuleNotFoundError, match=rf"Ticks.to_{package} needs the package {package}, of the extra 'frames'"
    ):
        getattr(simulated(), f"to_{package}")()


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_a_saved_file_holds_the_same_numbers(tmp_path, suffix):
    ticks, path = simulated(), tmp_path / f"ticks{suffix}"
    ticks.save(path)
    read = pyarrow.csv.read_csv(path) if suffix == ".csv" else pyarrow.parquet.read_table(path)
    assert read.column_names == list(flatten(ticks))
    assert np.array_equal(read["fy_N"].to_numpy(), ticks.force[:, 1])
    assert read["phase_1"].to_pylist() == ticks.to_arrow()["phase_1"].to_pylist()
    with pytest.raises(ValueError, match=r"must end in \.csv or \.parquet"):
        ticks.save(tmp_path / "ticks.txt")
    assert [file.name for file in tmp_path.iterdir()] == [path.name]


def test_a_plot_has_each_membranes_force_and_band():
    ticks = simulated()
    axes = ticks.plot()
    assert len(axes.lines) == 3 * 2 and axes.get_xlabel() == "time (s)"
    assert np.array_equal(axes.lines[3].get_ydata(), ticks.axial_force[:, 1])
    assert [text.get_text() for text in axes.get_legend().get_texts()] == list(ticks.membranes)
    assert on_a_line().plot().get_xlabel() == "depth (m)"
    assert ticks.replace(lost=np.zeros(len(ticks))).plot("lost").get_xlabel() == "lost"
    with pytest.raises(ValueError, match="x = 'position' is a vector"):
        ticks.plot("position")
    with pytest.raises(KeyError, match="needs the field ceiling"):
        ticks.plot("ceiling")


def test_what_a_tick_does_not_have_of_a_membrane_is_absent():
    flat = flatten(insertion(), 3)
    assert np.isnan(flat["depth_2_m"]).all() and (flat["phase_2"] == ABSENT).all()


def test_a_number_that_is_nan_is_not_taken_for_an_absent_membrane():
    ticks = insertion()
    depth, phase = ticks.depth.copy(), ticks.phase.copy()
    depth[3, 0] = np.nan
    depth[5, 1], phase[5, 1] = np.nan, ABSENT
    table = ticks.replace(depth=depth, phase=phase).to_arrow()
    assert table["depth_0_m"].null_count == 0 and np.isnan(table["depth_0_m"][3].as_py())
    assert [table[name].null_count for name in ("depth_1_m", "phase_1", "force_1_N")] == [1, 1, 1]


@pytest.mark.parametrize("phase", [[300.0], [-1], [0.5], ["outside"]])
def test_a_number_that_the_type_of_its_field_does_not_hold_is_refused(phase):
    with pytest.raises(ValueError, match="phase must hold numbers of type uint8, and holds others"):
        Ticks({"phase": phase})


def test_a_single_value_is_no_column():
    with pytest.raises(ValueError, match="force must be an array with one row per tick"):
        Ticks({"force": 1.0})


def test_ticks_do_not_import_masked_arrays_which_would_stop_a_thread_that_feeds_a_device():
    code = "import sys, punctura; punctura.Ticks({'force': [0.0]}); print('numpy.ma' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


def test_masked_elements_are_refused():
    masked = np.ma.masked_array([0.0, 1.0, 2.0], mask=[False, True, False])
    with pytest.raises(ValueError, match="time has masked elements"):
        Ticks({"time": masked})
    with pytest.raises(ValueError, match="position has masked elements"):
        pn.simulate(SCENE, masked)
    with pytest.raises(ValueError, match="p has masked elements"):
        pn.Insertion(SCENE).run(np.ma.masked_array(np.zeros((3, 3)), mask=np.eye(3)), [0, -1, 0])
    assert len(Ticks({"time": np.ma.masked_array([0.0, 1.0], mask=False)})) == 2
    whole = np.ma.masked_array(np.zeros((3, 3)), mask=False)
    assert len(pn.Insertion(SCENE).run(whole, [0, -1, 0])) == len(
        pn.Insertion(SCENE).run(pandas.DataFrame(whole), DOWN)
    )
