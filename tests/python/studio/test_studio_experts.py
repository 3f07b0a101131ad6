"""Any recording can be named as the expert's run of an exercise, if it has the exercise's membranes."""

import pytest
from attempts import as_a_device_runs_it
from punctura import load_scene
from punctura._core import SimulatedDevice
from punctura.simulation import RecordedMotion
from punctura.studio.experts import Experts
from recorded import recorded


def expert_of(page, name="venipuncture"):
    return next(entry["expert"] for entry in page.json("/api/exercises") if entry["name"] == name)


def test_a_recording_is_named_kept_and_taken_back(page, served):
    folder = served.session.shelf.folder
    for name, scene in (("hers", "venipuncture"), ("other", "k06-fig12")):
        at_rest = as_a_device_runs_it(load_scene(scene))
        motion = RecordedMotion([0.0, 1.0], [[0.0, 5e-3, 0.0], [0.0, 5e-3, 0.0]])
        device = SimulatedDevice(motion, real_time=False, ticks=500)
        recorded(served.session.shelf.file(name), device, at_rest, 500)
    assert expert_of(page) == ""
    assert page.ask(do="set_expert", exercise="venipuncture", recording="hers")["ok"]
    assert expert_of(page) == "hers" and expert_of(page, "epidural") == ""
    assert Experts(served.session.results.folder).all() == {"venipuncture": "hers"}  # after a restart, too
    refused = page.ask(do="set_expert", exercise="venipuncture", recording="other")
    assert not refused["ok"] and "has no membrane" in refused["problems"][0]["reason"]
    for recording in ("none", "../results/x"):
        assert not page.ask(do="set_expert", exercise="venipuncture", recording=recording)["ok"]
    assert not page.ask(do="set_expert", exercise="nothing", recording="hers")["ok"]
    assert expert_of(page) == "hers"
    (folder / "hers.parquet").unlink()
    assert expert_of(page) == ""
    assert page.ask(do="set_expert", exercise="venipuncture", recording="")["ok"]
    assert Experts(served.session.results.folder).all() == {}


@pytest.mark.parametrize("text", ["[1", "[]", '{"blind": 3}', "\udcff"])
def test_a_damaged_file_is_kept_under_another_name_and_told(tmp_path, text):
    data, path = text.encode("utf-8", "surrogateescape"), tmp_path / "results-experts.json"
    told = []
    experts = Experts(tmp_path / "results", told.append)
    for k in (1, 2):
        path.write_bytes(data)
        assert experts.all() == {} and len(told) == k
        assert f"results-experts-damaged-{k}.json" in told[-1]
        experts.set("blind", "a run")
        assert experts.all() == Experts(tmp_path / "results").all() == {"blind": "a run"}
        assert (tmp_path / f"results-experts-damaged-{k}.json").read_bytes() == data
    assert len(told) == 2


def test_the_page_is_told_that_the_file_was_damaged(page, served):
    folder = served.session.results.folder
    folder.mkdir(parents=True, exist_ok=True)
    (folder.parent / f"{folder.name}-experts.json").write_text("{", encoding="utf-8")
    assert expert_of(page) == ""
    page.wait(lambda: any("is damaged" in notice["text"] for notice in page.of("notice")))
