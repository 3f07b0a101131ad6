"""The core's table defines the fields of a tick; all readers of ticks use it and have no list of their own."""

import re
from pathlib import Path

import make_tick_table
import numpy as np
import punctura as pn
from punctura._core import TickArrays
from punctura.record import open_recording
from punctura.record.columns import LOST, NEW_SCENES
from punctura.simulation import Experiment, Strokes
from punctura.studio.wire import decode_ticks, encode_ticks
from punctura.ticks import COMMAND_SCENE, FIELDS
from punctura.ticks.fields import file_columns

ROOT = Path(__file__).parents[3]
SOURCE = (ROOT / "core/punctura/servo/tick_table.hpp").read_text() + (
    ROOT / "core/punctura/lab/plant/experiment.hpp"
).read_text()


def live_fields():
    return [field for field in FIELDS.values() if field.name not in ("true_position", "desired")]


def test_every_line_of_the_table_in_core_is_a_field_and_an_attribute():
    lines = re.findall(r'    tick_field\("(\w+)"', SOURCE)
    assert lines == list(FIELDS) and len(lines) > 25
    for name in lines:
        assert FIELDS[name].help in getattr(TickArrays, name).__doc__


def test_a_recording_has_the_columns_of_the_table_and_two_more(recording):
    columns = [column.name for column in file_columns(live_fields(), 2)]
    assert open_recording(recording).schema.names == [*columns, LOST, NEW_SCENES]


def test_a_recordings_ticks_have_the_fields_of_the_table(recording):
    ticks = open_recording(recording).ticks()
    assert list(ticks) == [*(field.name for field in live_fields()), LOST]
    assert ticks.membranes == tuple(placed.name for placed in pn.load_scene("k06-fig12").membranes)


def test_a_frame_has_the_fields_that_the_table_marks_for_the_page():
    ticks = Experiment(pn.load_scene("k06-fig12"), Strokes([0, 5e-3, 0], [0, -10e-3, 0])).run(0.1)
    frame = decode_ticks(encode_ticks(ticks, run=0))
    assert set(frame.ticks) == {field.name for field in FIELDS.values() if field.on_page}
    assert np.array_equal(frame.ticks.force, ticks.force.astype(np.float32))


def test_the_page_and_the_docs_have_the_table_as_it_is(capsys):
    assert make_tick_table.main(["--check"]) == 0, capsys.readouterr().out


def test_the_bit_of_a_new_scene_is_that_of_the_table():
    bits = dict(re.findall(r"(\d+) (a new scene|\w+)", FIELDS["commands"].help))
    assert bits[str(COMMAND_SCENE)] == "a new scene"
