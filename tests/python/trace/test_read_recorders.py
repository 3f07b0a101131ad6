"""TDMS files of LabVIEW and recordings of ROS."""

import sys

import numpy as np
import pytest
from nptdms import ChannelObject, TdmsWriter
from punctura.extras import MissingPackageError
from punctura.trace import TraceError, read_trace
from rosbags import rosbag1, rosbag2
from rosbags.typesys import Stores, get_typestore
from traces import trace

MADE = trace()
STEP = float(MADE.time[1] - MADE.time[0])


def check(read, depth=2e-6):
    assert read.depth == pytest.approx(MADE.depth, abs=depth) and read.force == pytest.approx(MADE.force, abs=1e-9)
    assert read.time - read.time[0] == pytest.approx(MADE.time - MADE.time[0], abs=1e-6)
    assert not read.findings


def write_tdms(path, groups, key="unit_string"):
    """Channels with the units of their properties; the time is that of the waveform."""
    waveform = {"wf_increment": STEP, "wf_start_offset": 0.0, "wf_samples": 1}
    channels = [
        ChannelObject(group, name, values, {key: unit} | waveform)
        for group in groups
        for name, values, unit in (("Weg", MADE.depth * 1e3, "mm"), ("Kraft", MADE.force * 1e3, "mN"))
    ]
    channels.append(ChannelObject("about", "code", np.arange(3)))
    with TdmsWriter(path) as writer:
        writer.write_segment(channels)


def test_a_tdms_file_has_units_and_a_time_of_its_own(tmp_path):
    write_tdms(tmp_path / "a.tdms", ["trial"])
    check(read_trace(tmp_path / "a.tdms"))
    write_tdms(tmp_path / "a.tdms", ["trial"], "NI_UnitDescription")
    check(read_trace(tmp_path / "a.tdms"))
    write_tdms(tmp_path / "b.tdms", ["1", "2"])
    with pytest.raises(TraceError, match="2 tables can be the trace: '1', '2'; choose one"):
        read_trace(tmp_path / "b.tdms")
    check(read_trace(tmp_path / "b.tdms", sheet="2"))
    (tmp_path / "c.tdms").write_bytes(b"TDSm" + bytes(50))
    with pytest.raises(TraceError, match=r"c\.tdms"):
        read_trace(tmp_path / "c.tdms")


def test_channels_of_other_rates_are_interpolated(tmp_path):
    made = [("Weg", MADE.depth[::10] * 1e3, "mm", 10 * STEP), ("Kraft", MADE.force, "N", STEP)]
    with TdmsWriter(tmp_path / "a.tdms") as writer:
        for name, values, unit, step in made:
            writer.write_segment([ChannelObject("1", name, values, {"unit_string": unit, "wf_increment": step})])
    read = read_trace(tmp_path / "a.tdms")
    assert np.ptp(read.time) == pytest.approx(np.ptp(MADE.time), abs=10 * STEP)
    assert read.depth == pytest.approx(np.interp(read.time, MADE.time - MADE.time[0], MADE.depth), abs=1e-4)


def test_a_tdms_file_that_was_cut_is_named_and_its_bytes_are_not_printed(tmp_path, capsys):
    write_tdms(tmp_path / "a.tdms", ["trial"])
    good = (tmp_path / "a.tdms").read_bytes()
    for share in (0.5, 0.9):
        (tmp_path / "b.tdms").write_bytes(good[: int(share * len(good))])
        with pytest.raises(TraceError, match=r"b\.tdms: is damaged or cut off"):
            read_trace(tmp_path / "b.tdms")
    (tmp_path / "c.tdms").write_bytes(good[:-10])  # of a channel that is not needed
    assert [one.kind for one in read_trace(tmp_path / "c.tdms").findings] == ["damaged"]
    assert capsys.readouterr() == ("", "")


def fill(writer, store, serialize, more):
    """A force sensor, and a depth at half of its rate."""
    types = {name.split("/")[-1]: kind for name, kind in store.types.items()}
    force, depth = "geometry_msgs/msg/WrenchStamped", "std_msgs/msg/Float64"
    connections = [writer.add_connection(*topic, typestore=store) for topic in (("/ft", force), ("/depth", depth))]
    for i, (t, d, f) in enumerate(zip(MADE.time.tolist(), MADE.depth.tolist(), MADE.force.tolist(), strict=True)):
        stamp = 1_700_000_000_000_000_000 + round(1e9 * t)
        time = store.types["builtin_interfaces/msg/Time"](sec=stamp // 10**9, nanosec=stamp % 10**9)
        header = types["Header"](stamp=time, frame_id="ft", **more)
        at_rest = types["Vector3"](x=0.0, y=0.0, z=0.0)
        wrench = types["Wrench"](force=types["Vector3"](x=0.1, y=0.2, z=f), torque=at_rest)
        message = types["WrenchStamped"](header=header, wrench=wrench)
        writer.write(connections[0], stamp, serialize(message, force))
        if i % 2 == 0 or i == len(MADE) - 1:
            writer.write(connections[1], stamp, serialize(types["Float64"](data=d), depth))


def test_the_topics_of_a_bag_are_joined_on_the_times_of_the_faster_one(tmp_path):
    store = get_typestore(Stores.ROS1_NOETIC)
    with rosbag1.Writer(tmp_path / "a.bag") as writer:
        fill(writer, store, store.serialize_ros1, {"seq": 0})
    store = get_typestore(Stores.ROS2_HUMBLE)
    with rosbag2.Writer(tmp_path / "b", version=8) as writer:
        fill(writer, store, store.serialize_cdr, {})
    units = {"depth": "m", "force": "N"}
    for path in (tmp_path / "a.bag", tmp_path / "b"):  # the topic names the only field of its messages
        check(read_trace(path, None, units), depth=STEP * 5e-3)  # at the turn
    with pytest.raises(TraceError, match=r"unit of the force column 'wrench\.force\.z' is not stated"):
        read_trace(tmp_path / "b")
    (tmp_path / "c.bag").write_text("none")
    with pytest.raises(TraceError, match=r"c\.bag"):
        read_trace(tmp_path / "c.bag")


@pytest.mark.parametrize(("name", "package"), [("a.tdms", "nptdms"), ("a.bag", "rosbags.highlevel")])
def test_one_sentence_names_the_package_that_is_missing(tmp_path, monkeypatch, name, package):
    (tmp_path / name).write_text("x")
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(MissingPackageError, match=f"needs the package {package.split('.')[0]}, of the extra 'formats'"):
        read_trace(tmp_path / name)
