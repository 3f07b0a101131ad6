"""Recordings for other programs."""

import csv
import json
import os
import shutil
import sys

import pyarrow.parquet as pq
import pytest
from mcap.reader import make_reader
from punctura import ConfigurationError, load_scene
from punctura.record import export, open_recording
from recorded import assert_same_table


@pytest.fixture
def killed(start, tmp_path):
    """A recording as a killed process leaves it, with a scene that came before its first tick."""
    run = start()
    run.recorder.exchange(load_scene("k06-fig10"))
    return run.killed(tmp_path / "killed.part")


def test_csv_reads_back_as_the_very_same_numbers(killed, tmp_path):
    result = export(killed, tmp_path / "out.csv")
    table = open_recording(killed).table()
    with (tmp_path / "out.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == result.ticks == 3000 and "new_scenes" not in rows[0]
    for name in ("x_m", "fy_N", "depth_0_m", "proxy_0_y_m", "tip_y_m"):
        assert [float(row[name]) for row in rows] == table[name].to_pylist()
    assert [row["phase_0"] for row in rows] == table["phase_0"].to_pylist()
    assert [int(row["tick"]) for row in rows] == list(range(3000))
    assert any("CSV cannot hold the scenes" in note for note in result.notes)


def test_parquet_of_a_killed_recording_is_a_finished_one(killed, tmp_path):
    export(killed, tmp_path / "out.parquet")
    out = open_recording(tmp_path / "out.parquet")
    assert out.finished and out.rows == 3000
    assert_same_table(out.table(), open_recording(killed).table())
    assert out.info.scene == load_scene("k06-fig12")
    assert any("was not finished" in note for note in out.notes)
    assert pq.read_table(tmp_path / "out.parquet")["phase_0"][0].as_py() == "outside"


def test_mcap_holds_every_tick_as_json_and_every_scene(killed, tmp_path):
    export(killed, tmp_path / "out.mcap")
    rows = open_recording(killed).table().drop_columns(["new_scenes"]).to_pylist()
    ticks, scenes, stamps = [], [], []
    with (tmp_path / "out.mcap").open("rb") as file:
        reader = make_reader(file)
        for schema, channel, message in reader.iter_messages(log_time_order=False):
            assert schema.encoding == "jsonschema" and channel.message_encoding == "json"
            (ticks if channel.topic == "punctura/tick" else scenes).append(json.loads(message.data))
            if channel.topic == "punctura/tick":
                stamps.append(message.log_time)
        (metadata,) = reader.iter_metadata()
    assert ticks == [{name: None if value != value else value for name, value in row.items()} for row in rows]
    assert [scene["tick"] for scene in scenes] == [0, 0]
    assert stamps[1600] - stamps[0] == pytest.approx(1e9, abs=300)
    assert json.loads(metadata.metadata["json"])["device"]["backend"] == "simulated"


def test_without_the_mcap_package_the_error_says_what_to_install(killed, tmp_path, monkeypatch, punctura):
    monkeypatch.setitem(sys.modules, "mcap.writer", None)
    done = punctura("export", killed, "--out", tmp_path / "out.mcap")
    assert done.status == 1 and "needs the package mcap, of the extra 'mcap'" in done.stderr
    assert not (tmp_path / "out.mcap").exists()


def test_the_command_tells_what_it_wrote(killed, tmp_path, punctura):
    done = punctura("export", killed, "--out", tmp_path / "out.csv", "--json")
    assert done.status == 0 and json.loads(done.stdout)["ticks"] == 3000
    assert "was not finished; it is complete up to tick 2999" in done.stderr


def test_places_that_cannot_be_are_told_all_at_once(killed, tmp_path):
    with pytest.raises(ConfigurationError) as error:
        export(killed, tmp_path / "nowhere" / "out.txt")
    assert len(error.value.problems) == 2
    with pytest.raises(ConfigurationError, match="is the recording itself"):
        shutil.copy(killed, tmp_path / "same.parquet")
        export(tmp_path / "same.parquet", tmp_path / "same.parquet")


def test_an_export_that_breaks_off_leaves_nothing(killed, tmp_path):
    def stop(_share):
        raise KeyboardInterrupt

    before = sorted(p.name for p in tmp_path.iterdir())
    for suffix in ("csv", "parquet", "mcap"):
        with pytest.raises(KeyboardInterrupt):
            export(killed, tmp_path / f"out.{suffix}", stop)
    assert sorted(p.name for p in tmp_path.iterdir()) == before


@pytest.mark.skipif(not hasattr(os, "O_TMPFILE"), reason="this system has no files without a name")
@pytest.mark.parametrize("kind", ["csv", "parquet", "mcap"])
def test_a_kill_while_an_export_is_written_leaves_nothing(start, tmp_path, kind):
    run = start(ticks=500).record()
    seen = []
    export(run.path, tmp_path / f"out.{kind}", lambda _: seen.append({path.name for path in tmp_path.iterdir()}))
    assert seen and all(names == {run.path.name} for names in seen)
    assert (tmp_path / f"out.{kind}").stat().st_size > 0
