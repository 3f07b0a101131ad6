"""A wrong description with a right checksum is rejected, with file and field, and does not affect other recordings."""

import json
import re

import pytest
import spoil_recording as tool
from punctura.record import RecordingError, open_recording
from punctura.studio.shelf import Shelf


@pytest.fixture
def recorded(start, tmp_path):
    """A finished recording, and the same one unfinished."""
    run = start(ticks=200)
    return {".part": run.killed(tmp_path / "killed.parquet.part"), ".parquet": run.path}


REQUIRED = ("format", "build", "began_ns", "rate_hz", "period_s", "device", "gate", "limits", "scene")
FIELDS = [
    *((field,) for field in REQUIRED),
    ("machine",), ("began",), ("libraries",), ("libraries", "numpy"), ("device", "backend"), ("device", "max_force"),
    ("device", "button_count"), ("gate", "stale"), ("limits", "max_force"),
]  # fmt: skip
FINISHED = [
    ("summary",), ("summary", "ticks"), ("summary", "first_tick"), ("summary", "lost"), ("summary", "faults"),
    ("summary", "notes"), ("summary", "damaged"), ("lost",), ("lost", "ring"), ("device_after",),
    ("device_after", "statements"),
]  # fmt: skip


@pytest.mark.parametrize("form", [".part", ".parquet"])
@pytest.mark.parametrize("place", [*FIELDS, ("about",), *FINISHED], ids=".".join)
def test_a_value_of_the_wrong_type_is_told_by_file_and_field(recorded, tmp_path, place, form):
    if form == ".part" and place in FINISHED:
        place = ("device",)
    data, bad = tool.description_of(recorded[form]) | {"about": {}}, tmp_path / f"bad{form}"
    for value in ([[]], None):
        tool.rewrite(recorded[form], bad, tool.changed(data, place, value))
        with pytest.raises(RecordingError, match=rf"{re.escape(str(bad))}.*{place[-1]}"):
            open_recording(bad)


@pytest.mark.parametrize("form", [".part", ".parquet"])
@pytest.mark.parametrize("field", REQUIRED)
def test_a_field_that_is_missing_is_reported(recorded, tmp_path, field, form):
    data = tool.description_of(recorded[form])
    del data[field]
    tool.rewrite(recorded[form], tmp_path / f"bad{form}", data)
    with pytest.raises(RecordingError, match=field):
        open_recording(tmp_path / f"bad{form}")


@pytest.mark.parametrize("value", [None, 3, "text", [], [1]])
def test_a_description_that_is_no_object_is_reported(recorded, tmp_path, value):
    tool.rewrite(recorded[".parquet"], tmp_path / "bad.parquet", value)
    with pytest.raises(RecordingError, match="not a JSON object"):
        open_recording(tmp_path / "bad.parquet")


@pytest.mark.parametrize("value", ["\ud800", 1e999, json.loads("[" * 200 + "]" * 200)])
def test_what_could_not_be_written_as_json_again_is_reported(recorded, tmp_path, value):
    data = tool.description_of(recorded[".parquet"])
    tool.rewrite(recorded[".parquet"], tmp_path / "bad.parquet", data | {"about": {"title": value}})
    with pytest.raises(RecordingError, match=r"bad\.parquet: the run description is invalid"):
        open_recording(tmp_path / "bad.parquet")


def test_a_key_of_another_version_is_kept(recorded, tmp_path):
    data = tool.description_of(recorded[".parquet"])
    data = tool.changed(data | {"weather": {"sun": True}}, ("summary", "mood"), "good")
    tool.rewrite(recorded[".parquet"], tmp_path / "more.parquet", data)
    assert open_recording(tmp_path / "more.parquet").info.data == data


@pytest.mark.parametrize("key", ["stale", "weather"])
def test_limits_that_cannot_be_are_told_where_they_are_needed(recorded, tmp_path, key):
    data = tool.description_of(recorded[".parquet"])
    tool.rewrite(recorded[".parquet"], tmp_path / "bad.parquet", tool.changed(data, ("gate", key), -1))
    recording = open_recording(tmp_path / "bad.parquet")
    with pytest.raises(RecordingError, match=rf"bad\.parquet: gate .*{key}"):
        _ = recording.info.gate


def test_columns_that_are_none_of_a_recording_are_reported(recorded, tmp_path):
    import pyarrow as pa
    import pyarrow.parquet as pq
    from punctura.record.header import to_metadata

    table, data = pq.read_table(recorded[".parquet"]), tool.description_of(recorded[".parquet"])
    for spoilt, words in (
        (table.drop_columns(["fault"]), "without fault"),
        (table.drop_columns(["upper_1_N"]), "without upper_1_N"),
        (table.set_column(0, "tick", pa.array(["a"] * len(table))), r"with tick \(string\)"),
    ):
        bare = spoilt.replace_schema_metadata(None)
        pq.write_table(bare.replace_schema_metadata(to_metadata(data, bare.schema)), tmp_path / "bad.parquet")
        with pytest.raises(RecordingError, match=words):
            open_recording(tmp_path / "bad.parquet")


@pytest.mark.parametrize("place", [("period_s",), ("began",), ("summary", "ticks"), ("scene",)], ids=".".join)
def test_a_bad_recording_is_left_out_of_the_list_and_the_good_one_stays(recorded, tmp_path, place):
    folder = tmp_path / "kept"
    folder.mkdir()
    data = tool.description_of(recorded[".parquet"])
    tool.rewrite(recorded[".parquet"], folder / "bad.parquet", tool.changed(data, place, [[]]))
    tool.rewrite(recorded[".parquet"], folder / "good.parquet", data)
    assert [entry.name for entry in Shelf(folder).entries()] == ["good"]


@pytest.mark.parametrize("verb", [("replay",), ("export", "--out", "out.csv"), ("run", "--headless", "--device")])
def test_the_command_line_says_so_in_one_sentence(recorded, tmp_path, verb, punctura, monkeypatch):
    monkeypatch.chdir(tmp_path)
    data = tool.description_of(recorded[".parquet"])
    tool.rewrite(recorded[".parquet"], tmp_path / "bad.parquet", tool.changed(data, ("summary", "lost"), "many"))
    file = "replay:bad.parquet" if verb[0] == "run" else "bad.parquet"
    done = punctura(*([*verb, file] if verb[0] == "run" else [verb[0], file, *verb[1:]]))
    report = " ".join(done.stderr.replace("│", " ").split())
    assert done.status in (1, 2) and "summary.lost = 'many': input should be a valid integer" in report


def test_a_fault_that_this_version_does_not_know_is_counted_by_its_number(start, tmp_path):
    import pyarrow as pa
    from punctura.record.part_file import Survey

    batch = pa.RecordBatch.from_pydict(
        {"tick": pa.array([0, 1]), "lost": pa.array([0, 0]), "fault": pa.array([0, 200], pa.uint8()),
         "new_scenes": pa.nulls(2)}
    )  # fmt: skip
    survey = Survey()
    survey.add(batch)
    (fault,) = survey.summary().faults
    assert (fault.tick, fault["fault"], fault.meaning) == (1, "200", "unknown to this version")
    with pytest.raises(KeyError):
        fault["model_dump"]


def test_a_field_is_found_by_its_name_and_only_a_field(recorded):
    summary = open_recording(recorded[".parquet"]).summary
    more = type(summary).model_validate(summary.model_dump() | {"of a later version": 7})
    assert (more["ticks"], more["lost"], more["of a later version"]) == (200, 0, 7)
    for name in ("model_dump", "none"):
        with pytest.raises(KeyError, match=name):
            more[name]
