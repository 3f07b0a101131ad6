"""Recordings and exercises of a studio: made, listed, read, played back, downloaded, deleted."""

import json
import struct
import unicodedata

import numpy as np
import pyarrow.parquet as pq
import pytest
from punctura import load_scene
from punctura._core import ServoLoop, SimulatedDevice
from punctura.exercise import load_exercise
from punctura.record import Recorder, open_recording, replay
from punctura.record.header import to_metadata
from punctura.simulation import Strokes
from punctura.studio.client import StudioClient
from punctura.studio.wire import decode_ticks


def frames_of(body):
    at, frames = 0, []
    while at < len(body):
        assert at % 4 == 0
        (length,) = struct.unpack_from("<I", body, at)
        frames.append(decode_ticks(body[at + 4 : at + 4 + length]))
        at += 4 + length + -length % 4
    return frames


def record(page, name=None, edit=True):
    """A short recording with a pop and a scene edit. Returns the answer of stop_recording."""
    assert page.ask(do="start_recording", name=name)["ok"]
    seen = len(page.of("event"))
    assert page.ask(do="strokes", period=1.0)["ok"]
    page.wait(lambda: any(e["what"] == "pop" for e in page.of("event")[seen:]))
    if edit:
        tables = page.of("scene")[-1]["scene"]["tables"]
        tables["membrane"][0]["friction"] += 0.05
        assert page.ask(do="edit", tables=tables)["ok"]
    page.wait(lambda: any(e["what"] == "out" for e in page.of("event")[seen:]))
    page.wait(lambda: page.of("recording") and page.of("recording")[-1]["rows"] > 0)
    return page.ask(do="stop_recording")


def test_a_page_hears_at_once_that_nothing_is_recorded(page):
    """It may have been open before this studio, and show the recording of another one that has gone."""
    page.wait(lambda: page.of("recording"))
    assert page.of("recording")[0]["name"] == ""
    page.wait(lambda: page.of("exercise"))
    assert not page.of("exercise")[0]["running"]


def test_a_recording_is_made_listed_read_downloaded_and_deleted(served, page):
    stopped = record(page, "Größe 1")
    assert stopped["ok"] and stopped["data"]["recording"] == "Größe 1" and stopped["data"]["lost"] == 0
    assert page.of("recording")[-1]["name"] == ""

    (entry,) = page.json("/api/recordings")
    rows = stopped["data"]["rows"]
    assert (entry["name"], entry["title"], entry["ticks"], entry["lost"]) == ("Größe 1", "Größe 1", rows, 0)
    assert entry["finished"] and entry["scene"] == "K06 Fig. 12" and entry["seconds"] == pytest.approx(rows / 1600)

    seen = page.json("/api/recordings/Größe 1")
    assert (seen["ticks"], seen["first_tick"]) == (rows, 0)
    assert seen["scene"]["tables"]["membrane"][0]["friction"] == 0.2  # the scene it began with
    pops = [e for e in page.of("event") if e["what"] == "pop"]
    assert [e for e in seen["events"] if e["what"] == "pop"][: len(pops)] == pops

    frames = frames_of(page.get("/api/recordings/Größe 1/ticks")[1])
    assert sum(len(f) for f in frames) == rows
    column = open_recording(served.session.shelf.find("Größe 1")).column("fy_N")
    assert np.array_equal(np.concatenate([f.ticks.force[:, 1] for f in frames]), column.astype(np.float32))
    assert replay(served.session.shelf.find("Größe 1")).identical

    for kind, begin in (("parquet", b"PAR1"), ("csv", b"tick,"), ("mcap", b"\x89MCAP")):
        status, body = page.get(f"/api/recordings/Größe 1/download?format={kind}")
        assert status == 200 and body.lstrip(b'"').startswith(begin), (kind, body[:20])
    assert page.get("/api/recordings/Größe 1/download?format=exe")[0] == 400
    assert page.get("/api/recordings/Größe 1", "DELETE")[0] == 204
    assert page.json("/api/recordings") == []
    assert page.get("/api/recordings/Größe 1")[0] == 404
    # What an export needed goes once its answer is out.
    page.wait(lambda: not list(served.session.shelf.folder.iterdir()))


def test_a_hand_follows_a_recorded_motion(page):
    name = record(page, edit=False)["data"]["recording"]
    seen = len(page.of("event"))
    assert page.ask(do="play_motion", recording=name)["ok"]
    page.wait(lambda: page.status()["hand"] == "motion")
    page.wait(lambda: any(e["what"] == "pop" for e in page.of("event")[seen:]))
    page.wait(lambda: page.status()["hand"] == "target")
    assert not page.ask(do="play_motion", recording="nothing")["ok"]


def test_one_recording_at_a_time_and_no_name_twice(served, page):
    assert not page.ask(do="stop_recording")["ok"]
    assert page.ask(do="start_recording", name="one")["ok"]
    assert not page.ask(do="start_recording", name="two")["ok"]
    assert page.json("/api/recordings") == []
    assert page.get("/api/recordings/one", "DELETE")[0] == 409
    assert page.ask(do="stop_recording")["ok"]
    again = page.ask(do="start_recording", name="one")
    assert not again["ok"] and "already" in again["text"]


@pytest.mark.parametrize("name", ["../up", "a/b", "a\\b", ".hidden", "a\nb", "CON", "x:y", "end.", " a", "é" * 81])
def test_a_name_that_is_no_file_s_is_refused_and_the_run_goes_on(served, page, name):
    assert not page.ask(do="start_recording", name=name)["ok"]
    run = page.last.run
    page.wait(lambda n=page.ticks: page.ticks > n + 100)
    assert page.last.run == run and not list(served.session.shelf.folder.glob("*"))


def test_another_scene_ends_a_recording_and_keeps_it(served, page):
    assert page.ask(do="start_recording", name="kept")["ok"]
    page.wait(lambda n=page.ticks: page.ticks > n + 400)
    assert page.ask(do="load", scene="k06-fig10")["ok"]
    entry = page.wait(lambda: [e for e in page.json("/api/recordings") if e["finished"]])[0]
    assert entry["name"] == "kept" and entry["ticks"] >= 400


def test_the_end_of_the_studio_finishes_a_recording(served, page):
    assert page.ask(do="start_recording", name="last")["ok"]
    page.wait(lambda n=page.ticks: page.ticks > n + 400)
    served.stop()
    recording = open_recording(served.session.shelf.find("last"))
    assert recording.finished and recording.lost == 0 and recording.rows >= 400


def test_a_folder_that_cannot_be_written_is_reported(served, page):
    served.session.shelf.folder.write_text("a file stands in the way")
    answer = page.ask(do="start_recording", name="x")
    assert not answer["ok"] and answer["text"]
    page.wait(lambda n=page.ticks: page.ticks > n + 100)


def practise(page, way):
    """Starts the venipuncture and pushes `way` m along the needle."""
    exercise = load_exercise("venipuncture")
    start, axis = np.array(exercise.start_position), np.array(exercise.start_axis)
    assert page.ask(do="start_exercise", exercise="venipuncture", person="Ada")["ok"]
    page.wait(lambda: page.of("exercise")[-1]["running"])
    for k in range(1, 61):
        page.target((start + axis * way * k / 60).tolist(), axis.tolist())
        page.wait(lambda n=page.ticks: page.ticks > n + 60)


def ended(page):
    return page.wait(lambda: page.of("exercise")[-1]["result"] or None, 30)


def test_the_venipuncture_is_failed_by_going_through_the_back_wall(page):
    practise(page, 50e-3)
    result = page.json(f"/api/results/{ended(page)}")
    assert not result["passed"] and result["person"] == "Ada" and result["metrics"]["entries"] == 1
    assert any(g["state"] == "missed" and "back vein wall" in g["text"] for g in result["goals"])
    seen = page.json(f"/api/recordings/{result['recording']}")
    assert seen["scene"]["lumen"] == [1, 2]
    assert [e["what"] for e in seen["events"]][:1] == ["touch"]
    # The laws are those of the needle that went in: 30 degrees to the skin.
    assert [law["obliquity"] for law in seen["scene"]["laws"]] == pytest.approx([np.pi / 3] * 3, abs=1e-3)
    assert page.of("exercise")[-1]["running"] is False
    status, table = page.get(f"/api/results/{result['name']}/download?format=csv")
    assert status == 200 and b"Ada" in table
    assert json.loads(page.get(f"/api/results/{result['name']}/download")[1])[0]["name"] == result["name"]
    assert [r["name"] for r in page.json("/api/results?person=Ada")] == [result["name"]]
    assert page.json("/api/results?person=Bob") == []
    assert page.get(f"/api/results/{result['name']}", "DELETE")[0] == 204
    assert page.get(f"/api/results/{result['name']}")[0] == 404


def test_an_exercise_that_is_ended_before_it_began_leaves_no_result(page):
    assert page.ask(do="start_exercise", exercise="epidural")["ok"]
    page.wait(lambda: page.of("exercise")[-1]["running"])
    tables = page.of("scene")[-1]["scene"]["tables"]
    assert not page.ask(do="edit", tables=tables)["ok"]
    assert not page.ask(do="stop_recording")["ok"]
    assert page.ask(do="end_exercise")["ok"]
    page.wait(lambda: not page.of("exercise")[-1]["running"])
    assert page.of("exercise")[-1]["result"] == "" and page.json("/api/results") == []
    assert not page.ask(do="end_exercise")["ok"]
    assert not page.ask(do="start_exercise", exercise="../x")["ok"]


def test_exercises_say_where_the_needle_begins(page):
    names = {e["name"]: e for e in page.json("/api/exercises")}
    assert names["venipuncture"]["space"] == [1, 2] and names["venipuncture"]["start_position"] == pytest.approx(
        [-0.013, 0.005, 0]
    )
    assert all(e["goals"] and e["instruction"] for e in names.values())
    with pytest.raises(ValueError, match="404"):
        page.json("/api/nothing")


def test_who_comes_during_an_exercise_is_told_of_it(served, page):
    assert page.ask(do="start_exercise", exercise="venipuncture")["ok"]
    page.wait(lambda: page.of("exercise")[-1]["running"])
    with StudioClient(served.address.url) as other:
        other.wait(lambda: any(e["running"] for e in other.of("exercise")))
        assert other.of("scene")[0]["scene"]["name"] == "Venipuncture"


@pytest.mark.parametrize("address", ["", "/ticks", "/trace", "/download?format=parquet", "/download?format=csv"])
def test_a_recording_that_is_finished_while_it_is_read_comes_all_the_same(served, page, monkeypatch, address):
    record(page, "one", edit=False)
    shelf = served.session.shelf
    find, asked = shelf.find, []

    def just_before(name):
        asked.append(name)
        path = find(name)
        return path.with_name(f"{path.name}.part") if len(asked) == 1 else path

    monkeypatch.setattr(shelf, "find", just_before)
    status, body = page.get(f"/api/recordings/one{address}")
    assert (status, len(asked)) == (200, 2)
    assert len(body) > 1_000


@pytest.mark.parametrize("then", ["deleted", "a link"])
def test_a_recording_that_is_gone_while_it_is_read_is_not_there(served, page, monkeypatch, tmp_path, then):
    record(page, "one", edit=False)
    shelf = served.session.shelf
    find, asked = shelf.find, []

    def just_before(name):
        path = find(name)
        asked.append(path)
        path.rename(tmp_path / "elsewhere.parquet")
        if then == "a link":
            path.symlink_to(tmp_path / "elsewhere.parquet")
        return path.with_name("nothing.parquet")

    monkeypatch.setattr(shelf, "find", just_before)
    assert page.get("/api/recordings/one")[0] == 404
    assert len(asked) == 1


@pytest.mark.parametrize("form", ["NFC", "NFD"])
def test_a_name_is_the_same_in_both_spellings_of_its_accents(served, page, form):
    spelt = unicodedata.normalize(form, "Größe é")
    assert page.ask(do="start_recording", name=unicodedata.normalize("NFD", "Größe é"))["ok"]
    status, text = page.get(f"/api/recordings/{spelt}", "DELETE")
    assert status == 409 and b"stop it first" in text
    page.wait(lambda: page.of("recording") and page.of("recording")[-1]["rows"] > 0)
    stopped = page.ask(do="stop_recording")
    assert stopped["text"] == "" and stopped["data"]["lost"] == 0
    assert [entry["name"] for entry in page.json("/api/recordings")] == ["Größe é"]
    assert page.json(f"/api/recordings/{spelt}")["ticks"] == stopped["data"]["rows"]
    assert page.get(f"/api/recordings/{spelt}/ticks")[0] == 200
    assert page.get(f"/api/recordings/{spelt}/download?format=csv")[0] == 200
    again = page.ask(do="start_recording", name=spelt)
    assert not again["ok"] and "already" in again["text"]
    assert page.get(f"/api/recordings/{spelt}", "DELETE")[0] == 204


def test_what_another_program_records_into_the_folder_is_not_deleted(served, page):
    folder = served.session.shelf.folder
    folder.mkdir()
    loop = ServoLoop(SimulatedDevice(Strokes((0, 5e-3, 0), (0, -0.02, 0))), load_scene("k06-fig10"))
    with Recorder(loop, folder / "other.parquet"):
        assert page.get("/api/recordings/other", "DELETE")[0] == 409
    assert page.get("/api/recordings/other", "DELETE")[0] == 204


def test_one_that_cannot_be_read_hides_no_other(served, page):
    record(page, "good", edit=False)
    folder, good = served.session.shelf.folder, served.session.shelf.find("good")
    table = pq.read_table(good)
    data = open_recording(good).info.data | {"period_s": "long"}
    pq.write_table(table.replace_schema_metadata(to_metadata(data, table.schema)), folder / "bad.parquet")
    assert [entry["name"] for entry in page.json("/api/recordings")] == ["good"]
    status, text = page.get("/api/recordings/bad")
    assert status == 422 and b"period_s = 'long'" in text


def test_what_a_kill_left_without_a_tick_blocks_no_name(served, page):
    folder = served.session.shelf.folder
    folder.mkdir()
    (folder / "again.parquet.part").touch()
    (folder / "mine.parquet.part").write_text("no recording")
    assert not page.ask(do="start_recording", name="mine")["ok"]
    assert page.ask(do="start_recording", name="again")["ok"]
    assert page.ask(do="stop_recording")["text"] == ""
