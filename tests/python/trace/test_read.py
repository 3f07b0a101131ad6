"""Traces from files, and the findings that name what is unusual."""

import numpy as np
import punctura as pn
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import scipy.io
from openpyxl import Workbook
from punctura.cli._trace import needle_of
from punctura.live import SimulatedDevice
from punctura.record import open_recording
from punctura.record.save_as import export_pieces
from punctura.simulation import Strokes
from punctura.trace import Trace, TraceError, read_trace, segment
from punctura.trace.samples import smoothed
from recorded import recorded
from scipy.signal import lfilter
from traces import force_of, trace


def columns_of(measured, **changes):
    columns = {"time_s": measured.time, "depth_mm": measured.depth * 1e3, "force_N": measured.force} | changes
    return {name: np.asarray(column) for name, column in columns.items() if column is not None}


def write_csv(path, columns, delimiter=",", decimal="."):
    rows = [delimiter.join(columns)]
    rows += [
        delimiter.join(str(cell).replace(".", decimal) for cell in row) for row in zip(*columns.values(), strict=True)
    ]
    path.write_text("\n".join(rows) + "\n")
    return path


def kinds(measured):
    return {finding.kind for finding in measured.findings}


def write_xlsx(path, columns):
    book = Workbook()
    book.active.append(list(columns))
    for row in zip(*columns.values(), strict=True):
        book.active.append([float(cell) for cell in row])
    book.save(path)


WRITERS = {
    "a.csv": write_csv,
    "semicolons.csv": lambda path, columns: write_csv(path, columns, ";", ","),
    "tabs.txt": lambda path, columns: write_csv(path, columns, "\t"),
    "a.parquet": lambda path, columns: pq.write_table(pa.table(columns), path),
    "a.mat": lambda path, columns: scipy.io.savemat(path, columns),
    "nested.mat": lambda path, columns: scipy.io.savemat(path, {"trial": columns}),
    "a.xlsx": write_xlsx,
}


@pytest.mark.parametrize("name", WRITERS)
def test_every_format_gives_the_same_trace(tmp_path, name):
    made = trace()
    WRITERS[name](tmp_path / name, columns_of(made))
    read = read_trace(tmp_path / name)
    np.testing.assert_allclose(read.depth, made.depth, rtol=1e-12)
    np.testing.assert_allclose(read.force, made.force, rtol=1e-12)
    np.testing.assert_allclose(read.time, made.time, rtol=1e-12)
    assert kinds(read) == set()


def test_a_recording_is_a_trace_along_the_needle(tmp_path):
    scene = pn.load_scene("k06-fig12")
    strokes = Strokes((0, 5e-3, 0), (0, -0.02, 0), count=1, duration=1, rest=0.2)
    recorded(tmp_path / "run.parquet", SimulatedDevice(strokes, real_time=False, ticks=3500), scene, 3500)
    read = read_trace(tmp_path / "run.parquet")
    assert np.ptp(read.depth) == pytest.approx(0.025, rel=0.1)
    assert read.force.max() > 0.5 and kinds(read) <= {"no_contact"}
    assert needle_of("", tmp_path / "run.parquet") == scene.needle  # so that nobody must state it
    (tmp_path / "run.csv").write_bytes(b"".join(export_pieces(open_recording(tmp_path / "run.parquet"), "csv")))
    exported = read_trace(tmp_path / "run.csv")
    for role in ("depth", "force", "time"):
        assert getattr(exported, role) == pytest.approx(getattr(read, role), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("name", ["Depth (mm)", "depth [mm]", "Displacement_mm", "position/mm", "INSERTION DEPTH mm"])
def test_columns_are_found_by_their_usual_names(tmp_path, name):
    made = trace()
    columns = {"t_s": made.time, name: made.depth * 1e3, "Load (N)": made.force}
    assert read_trace(write_csv(tmp_path / "a.csv", columns)).depth == pytest.approx(made.depth)


def test_units_are_stated_or_asked_for(tmp_path):
    made = trace()
    path = write_csv(tmp_path / "a.csv", {"depth": made.depth * 1e3, "force_N": made.force})
    with pytest.raises(TraceError, match=r"unit of the depth column 'depth' is not stated .*--unit depth=UNIT"):
        read_trace(path)
    assert read_trace(path, units={"depth": "mm"}).depth == pytest.approx(made.depth)
    with pytest.raises(TraceError, match="'furlong' is no unit of the depth"):
        read_trace(path, units={"depth": "furlong"})


def test_columns_that_nobody_can_guess_are_asked_for(tmp_path):
    made = trace()
    path = write_csv(tmp_path / "a.csv", {"a": made.depth, "b": made.force})
    with pytest.raises(TraceError, match=r"no column is known to be the depth .*The columns are 'a', 'b'"):
        read_trace(path)
    units = {"depth": "m", "force": "N"}
    assert read_trace(path, {"depth": "a", "force": 2}, units).force == pytest.approx(made.force)
    with pytest.raises(TraceError, match="there is no column 'c'"):
        read_trace(path, {"depth": "c"})
    with pytest.raises(TraceError, match="'speed' is no role"):
        read_trace(path, {"speed": "a"})


def test_a_force_that_has_lost_its_sign_gives_way_to_the_one_that_has_it(tmp_path):
    made = trace()
    columns = {"depth_mm": made.depth * 1e3, "rf3_N": -made.force, "absolute_force_N": np.abs(made.force)}
    read = read_trace(write_csv(tmp_path / "a.csv", columns))
    assert read.force == pytest.approx(made.force) and {"unsigned", "reversed_sign"} <= kinds(read)


def test_a_file_without_names_is_read_by_numbers(tmp_path):
    made = trace()
    np.savetxt(tmp_path / "a.csv", np.column_stack((made.depth, made.force)), delimiter=",")
    read = read_trace(tmp_path / "a.csv", {"depth": 1, "force": 2}, {"depth": "m", "force": "N"})
    assert read.force == pytest.approx(made.force) and kinds(read) == {"no_time"}


CHANGES = {
    "reversed_sign": lambda made: {"force_N": -made.force},
    "reversed_depth": lambda made: {"depth_mm": -made.depth * 1e3},
    "offset": lambda made: {"force_N": made.force + 0.2},
    "drift": lambda made: {"force_N": made.force + 0.1 * made.time / made.time[-1]},
    "no_time": lambda made: {"time_s": None},
    "rows_without_numbers": lambda made: {"force_N": np.where(np.arange(len(made)) % 50 == 7, np.nan, made.force)},
    "time_repeats": lambda made: {"time_s": np.where(np.arange(len(made)) % 20 == 7, np.roll(made.time, 1), made.time)},
    "gap": lambda made: {"time_s": made.time + (np.arange(len(made)) > 150)},
    "time_doubtful": lambda made: {"time_s": made.time * 1e3},
    "spikes": lambda made: {"force_N": made.force + 20.0 * (np.arange(len(made)) % 90 == 40)},
    "smoothed": lambda made: {"force_N": np.convolve(np.pad(made.force, 7, "edge"), np.ones(15) / 15, "valid")},
    "no_pull": lambda made: {"force_N": np.maximum(made.force, 0)},
    "cut_off": lambda made: {"force_N": np.minimum(made.force, 0.7 * made.force.max())},
    "depth_held": lambda made: {"depth_mm": np.repeat(made.depth[::20], 20)[: len(made)] * 1e3},
}


def test_a_number_for_no_reading_is_left_out_and_named(tmp_path):
    made = trace(hold=0.4)
    force, depth = made.force.copy(), made.depth * 1e3
    force[100:102], force[200], depth[50] = -9999, 1e30, 9999
    read = read_trace(write_csv(tmp_path / "a.csv", columns_of(made, force_N=force, depth_mm=depth)))
    assert kinds(read) == {"no_reading", "rows_without_numbers"}
    assert len(read) == len(made) - 4 and np.ptp(read.force) == np.ptp(made.force)
    named = [one.text for one in read.findings if one.kind == "no_reading"]
    assert ["9.999 m" in one for one in named] == [True, False] and "3 rows hold -9999 and 1e+30 N" in named[1]


def test_more_than_a_tenth_of_no_reading_stops_the_identification(tmp_path):
    made = trace(hold=0.4)
    force = np.where(np.arange(len(made)) % 5 == 2, -9999, made.force)
    read = read_trace(write_csv(tmp_path / "a.csv", columns_of(made, force_N=force)))
    assert kinds(read) == {"no_reading", "rows_without_numbers"}
    assert [one.severe for one in read.findings] == [False, True] and read.force.min() > -100


@pytest.mark.parametrize("kind", CHANGES)
def test_each_defect_is_named_and_no_other(tmp_path, kind):
    made = trace(hold=0.4)
    read = read_trace(write_csv(tmp_path / "a.csv", columns_of(made, **CHANGES[kind](made))))
    assert kinds(read) == {kind}
    if kind in ("reversed_sign", "offset"):
        assert read.force == pytest.approx(made.force, abs=5e-3)


@pytest.mark.parametrize("length", [5, 20, None], ids=["5 samples", "20 samples", "random walk"])
def test_slow_noise_of_a_sensor_is_not_called_smoothed(length):
    keeps = 1.0 if length is None else np.exp(-1 / length)
    white = np.random.default_rng(1).normal(size=(20, 300))
    for noise in lfilter([1.0], [1.0, -keeps], white, axis=1):
        assert not list(smoothed(noise[100:]))
    assert not list(smoothed(white[0] + 0.01 * np.arange(300) ** 2))  # a soft layer
    averaged = np.apply_along_axis(np.convolve, 1, white, np.ones(10) / 10, "valid")
    assert sum(bool(list(smoothed(noise))) for noise in averaged) > 15


def test_a_slow_force_beside_white_noise_is_not_called_smoothed():
    """A filter leaves no white noise, and its changes are unlike those that are further away than it is wide."""
    rng, time = np.random.default_rng(5), np.arange(300)
    for _ in range(20):
        fringes = 6 * np.sin(2 * np.pi * time / 110 + rng.uniform(0, 6))
        assert not list(smoothed(fringes + 0.25 * rng.normal(size=300)))
        creep = 30 * np.exp((time - 300) / rng.uniform(10, 40)) + np.cumsum(rng.normal(size=300))
        assert not list(smoothed(creep))


def test_a_force_that_moves_by_a_quarter_of_its_range_is_no_air(tmp_path):
    """A dome of rubber gives way before it is pressed hard: no part of it is air."""
    depth = np.concatenate((np.linspace(0, 3.7e-3, 700), np.linspace(3.7e-3, 0, 700)))
    dome = 0.6 * np.sin(np.pi * np.clip(depth / 3e-3, 0, 1)) + 1.8 * np.clip((depth - 3.3e-3) / 0.4e-3, 0, 1) ** 2
    force = dome + 5e-4 * np.random.default_rng(1).normal(size=len(depth))
    made = Trace(depth, force, np.arange(len(depth)) / 200)
    assert segment(made).contact is None
    read = read_trace(write_csv(tmp_path / "a.csv", columns_of(made)))
    assert "no_contact" in kinds(read) and not {"smoothed", "drift"} & kinds(read)


@pytest.mark.parametrize("changed", [lambda force: np.round(force, 1), lambda force: np.repeat(force[::10], 10)])
def test_a_force_in_coarse_steps_or_from_a_slow_logger_is_not_called_cut_off(tmp_path, changed):
    made = trace(hold=0.4)
    columns = columns_of(made, force_N=changed(made.force)[: len(made)])
    assert "cut_off" not in kinds(read_trace(write_csv(tmp_path / "a.csv", columns)))


@pytest.mark.parametrize(
    "kind, changes",
    [
        ("no_motion", lambda made, rng: {"depth_mm": rng.normal(size=len(made))}),
        ("no_force", lambda made, rng: {"force_N": rng.normal(size=len(made))}),
    ],
)
def test_a_trace_that_shows_nothing_is_severe_and_has_no_other_finding(tmp_path, kind, changes):
    made = trace()
    path = write_csv(tmp_path / "a.csv", columns_of(made, **changes(made, np.random.default_rng(3))))
    [finding] = read_trace(path).findings
    assert finding.kind == kind and finding.severe


def test_a_wrong_unit_is_named(tmp_path):
    made = trace()
    path = write_csv(tmp_path / "a.csv", {"time_s": made.time, "depth_m": made.depth * 1e3, "force_N": made.force})
    [finding] = [finding for finding in read_trace(path).findings if finding.kind == "wrong_unit"]
    assert not finding.severe and "another test than the insertion" in finding.text  # a stated unit is never refused
    assert "state it (--unit depth=UNIT)" in finding.text


@pytest.mark.parametrize("name, what", [("depth_m", "depth"), ("force_N", "force")])
def test_a_column_that_never_changes_is_severe(tmp_path, name, what):
    made = trace()
    columns = {"time_s": made.time, "depth_m": made.depth, "force_N": made.force} | {name: np.full(len(made), 0.3)}
    severe = [finding for finding in read_trace(write_csv(tmp_path / "a.csv", columns)).findings if finding.severe]
    assert [finding.kind for finding in severe] == ["constant"] and f"the {what} is the same" in severe[0].text


def test_motions_whose_time_begins_again_inside_are_one_trace(tmp_path):
    made = trace(noise=2e-3)
    turn = int(np.argmax(made.depth)) + 50
    parted = np.concatenate((made.time[:turn], made.time[turn:] - made.time[turn]))
    rows = np.column_stack([parted, 1e3 * made.depth, made.force])
    path = tmp_path / "two.csv"
    np.savetxt(path, rows, delimiter=",", header="time_s,depth_mm,force_N", comments="", fmt="%.8g")
    read = read_trace(path)
    assert kinds(read) == {"time_begins_again"} and read.time == pytest.approx(made.time - made.time[0], abs=1e-6)
    np.savetxt(path, np.vstack((rows, rows)), delimiter=",", header="time_s,depth_mm,force_N", comments="")
    assert "time_begins_again" not in kinds(read_trace(path))  # in air another specimen may follow


def test_time_that_goes_back_is_named(tmp_path):
    made = trace()
    time = made.time.copy()
    time[100:110] = time[40]
    read = read_trace(write_csv(tmp_path / "a.csv", columns_of(made, time_s=time)))
    assert kinds(read) == {"time_goes_back"} and len(read) == len(made) - 10


def test_a_digitised_trace_with_two_forces_at_many_times_keeps_its_time(tmp_path):
    made = trace()
    time = made.time.copy()
    time[1::5], time[3::5] = time[0::5][: len(time[1::5])], time[2::5][: len(time[3::5])]
    read = read_trace(write_csv(tmp_path / "a.csv", columns_of(made, time_s=time)), {"time": "time_s"})
    [repeats] = read.findings
    assert repeats.kind == "time_repeats" and not repeats.severe
    assert read.time is not None and len(read) == np.unique(time).size


@pytest.mark.parametrize(("turned", "named"), [(-1, "time goes back"), (0, "have the time of the sample before")])
def test_a_time_that_leaves_too_few_samples_says_why_and_what_to_do(tmp_path, turned, named):
    made = trace()
    file = write_csv(tmp_path / "a.csv", columns_of(made, time_s=turned * made.time))
    with pytest.raises(
        TraceError, match=rf"{named}.* needs at least 5 samples, and 1 would be left: check which column"
    ):
        read_trace(file, {"time": "time_s"})


def test_no_withdrawal_and_no_pop_are_named(tmp_path):
    made = trace()
    only_in = made[: int(np.argmax(made.depth))]
    assert kinds(read_trace(write_csv(tmp_path / "a.csv", columns_of(only_in)))) == {"no_withdrawal"}
    before_pop = only_in[only_in.depth < 7e-3]
    read = read_trace(write_csv(tmp_path / "b.csv", columns_of(before_pop)))
    assert kinds(read) == {"no_withdrawal", "no_pop"}


def test_a_withdrawal_alone_is_no_insertion_with_a_reversed_depth(tmp_path):
    made = trace()
    out = made[int(np.argmax(made.depth)) + 100 :]  # from within the rest on
    [finding] = read_trace(write_csv(tmp_path / "a.csv", columns_of(out))).findings
    assert finding.kind == "no_insertion" and finding.severe
    inside = made[int(np.argmax(made.depth)) + 150 :]
    inside = inside[: int(np.argmax(inside.depth < 7e-3))]  # the needle stays in the tissue, which pulls
    [finding] = read_trace(write_csv(tmp_path / "a.csv", columns_of(inside))).findings
    assert finding.kind == "no_insertion" and finding.severe
    into = made[: int(np.argmax(made.depth))]
    for force in (into.force, -into.force, into.force + 1.0):
        read = read_trace(write_csv(tmp_path / "b.csv", columns_of(into, depth_mm=-1e3 * into.depth, force_N=force)))
        assert "reversed_depth" in kinds(read) and read.force.max() == pytest.approx(made.force.max(), abs=0.05)


@pytest.mark.parametrize("zero", [0.0, 0.5])
def test_a_trace_that_begins_in_the_tissue_has_its_zero_behind_it(tmp_path, zero):
    made = trace()
    late = made[int(np.argmax(made.depth > 5.5e-3)) :]
    read = read_trace(write_csv(tmp_path / "a.csv", columns_of(late, force_N=late.force + zero)))
    assert kinds(read) == ({"no_contact", "offset"} if zero else {"no_contact"})
    assert read.force == pytest.approx(late.force, abs=0.01)


def test_spikes_are_left_out_and_hide_no_pop(tmp_path):
    made = trace()
    force = made.force.copy()
    force[[300, 700]] += (9.0, -7.0)
    read = read_trace(write_csv(tmp_path / "a.csv", columns_of(made, force_N=force)))
    [finding] = read.findings
    assert finding.kind == "spikes" and finding.repaired and "2, by up to" in finding.text
    assert read.force == pytest.approx(np.delete(made.force, [300, 700]))


def test_a_needle_that_rests_in_air_has_no_reversed_sign(tmp_path):
    steps = np.concatenate([np.r_[np.arange(k, k + 1, 0.04), np.full(50, k + 1.0)] for k in range(12)]) * 1e-3
    for seed in range(8):
        force = force_of(steps) + 8e-3 * np.random.default_rng(seed).normal(size=len(steps))
        columns = {"time_s": np.arange(len(steps)) / 50, "depth_mm": steps * 1e3, "force_N": force}
        assert kinds(read_trace(write_csv(tmp_path / "a.csv", columns))) <= {"no_withdrawal"}


def test_a_digitised_curve_is_sorted_on_request(tmp_path):
    made = trace()[:600]
    order = np.random.default_rng(3).permutation(len(made))
    path = write_csv(tmp_path / "a.csv", {"depth_m": made.depth[order], "force_N": made.force[order]})
    assert read_trace(path, order="depth").depth == pytest.approx(made.depth)


@pytest.mark.parametrize("name", ["a.csv", "a.parquet", "a.mat", "a.xlsx"])
@pytest.mark.parametrize("content", [b"", b"\x00\xff" * 40, b"one,two\nthree,four\n"])
def test_a_file_that_is_no_table_is_refused_in_words(tmp_path, name, content):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(TraceError, match=str(tmp_path / name)):
        read_trace(tmp_path / name)
