"""A session in the studio without a browser: what the page is told, what it answers, what the needle did."""

import errno
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from participant import SCALED, TOLD, sat, saved
from protocols import COMPARES, RIGHT, YES, written
from punctura._core import DeviceError, Fault, ForceLimits
from punctura.live import RunLimits
from punctura.perception import DiskFullError, Session, SessionError, load_protocol, read_session, write_report
from punctura.perception.session import check_recordings
from punctura.record import open_recording
from punctura.record.append_file import AppendFile
from punctura.record.header import from_text
from punctura.studio.client import StudioClient
from punctura.studio.loaded import Loaded
from punctura.studio.run import Run, Settings
from punctura.studio.sitting import PerceptionSitting
from punctura.ticks import COMMAND_SCENE, Ticks
from pydantic import BaseModel
from waiting import LATE_ALLOWED, wait_until

REMEDY = 'mend this (on a full disk, free some space), then press "Go on" at the page'
GERMAN = """
[words]
agree = "Sind Sie einverstanden?"
yes = "Ja"
go_on = "Weiter"
interval = "Durchgang {trial}, Teil {interval}: {stroke}"
second = "zweite"
"""


def raised(error: Exception) -> None:
    raise error


def test_a_session_is_recorded_and_goes_on(tmp_path: Path) -> None:
    text = 'consent = "I agree."\nnoise = true\n' + COMPARES + GERMAN
    with sat(tmp_path, text) as (person, _):
        person.reads("simulated one is used, and no hand feels a force. I agree. Sind Sie einverstanden?")
        assert person.now["noise"]
        assert not person.page.ask(do="load", scene="venipuncture")["ok"]  # a session has the studio for itself
        assert [one["key"] for one in person.now["answers"]] == ["Ja", "no"]  # no single key gives consent
        assert person.now["typed"] == "Type Ja or no, then Enter"
        person.answers("ja")
        person.reads("The session begins.")  # what is left out is English
        person.answers("Weiter")
        assert person.page.ask(do="sound", plays=True)["ok"]
        person.goes_through("Durchgang 1, Teil 1: push the needle through the tissue")
        person.goes_through("Durchgang 1, Teil 2: push the needle through the tissue")
        person.reads("Which one fell more?")
        assert [one["key"] for one in person.now["answers"]] == ["1", "2"] and person.now["covered"]
        person.answers("zweite")
        person.reads("Durchgang 2")
        (first,) = saved(tmp_path)
        status, why = person.page.get(f"/api/recordings/{first.recordings[0].removesuffix('.parquet')}", "DELETE")
        assert status == 409 and b"A participant's session runs." in why
    header = read_session(tmp_path / "out" / "P01.jsonl")[0]
    assert header.consent and header.consented == "I agree. Sind Sie einverstanden? Ja" and first.answer == "second"
    check_recordings(header, [first], tmp_path / "out")
    with pytest.raises(SessionError, match="is the recording of trial 0 of P01, not of trial 1 of P01: restore it"):
        check_recordings(header, [first.model_copy(update={"trial": 1})], tmp_path / "out")
    recording = open_recording(tmp_path / "out" / first.recordings[0])
    levels = [0.41, 0.41]
    levels[first.position] = first.level
    exchanged = recording.table()["new_scenes"].drop_null().to_pylist()[-1][-1]
    felt_scenes = [recording.info.scene, from_text(exchanged, tmp_path)]
    assert [one.membranes[0].membrane.precompression for one in felt_scenes] == levels
    assert all(felt.drop > 0.1 for felt in first.felt)  # how much depends on the hand
    assert all(felt.scale == 0.8 and felt.pops == 1 for felt in first.felt)
    with sat(tmp_path, text) as (person, _):
        person.reads("No haptic device")
        person.reads("1 of 120 trials are done.")


def test_a_trial_without_the_masking_noise_is_repeated(tmp_path: Path) -> None:
    """Also if the noise ceases in the last interval alone, or the page that played it is gone."""
    with sat(tmp_path, "noise = true\n" + COMPARES) as (person, server):
        person.reads("The session begins.")
        for plays in ((False,), (True, False), (True, True)):
            person.answers("Go on")
            for interval, sound in enumerate(plays, 1):
                person.reads(f"interval {interval}")
                assert person.page.ask(do="sound", plays=sound)["ok"]
                person.goes_through()
            if not all(plays):
                person.reads("The masking noise did not play: touch the page, or press a key. The trial is repeated.")
                assert TOLD[-1].endswith("did not play the masking noise: click its page once, or allow it sound")
        person.reads("Which one fell more?")
        assert not saved(tmp_path)
        person.answers("first")
        person.reads("Trial 2")
        person.page.close()
        wait_until(lambda: not server.session.sitting.noise_plays)
    (line,) = saved(tmp_path)
    assert line.recordings == ("P01-0000-3.parquet",)


def test_everything_that_is_written_names_the_device(tmp_path: Path) -> None:
    protocol, device = load_protocol(written(tmp_path, YES + SCALED)), "PHANTOM Omni, simulated"
    with sat(tmp_path, YES) as (person, _):
        person.reads("The session begins.")
        person.answers("Go on")
        person.goes_through()
        person.reads("Did it pop?")
        person.answers("yes")
    header = read_session(tmp_path / "out" / "P01.jsonl")[0]
    assert header.device == device and header.device_simulated
    with pytest.raises(SessionError, match=f"began on {device}, and this is Touch: choose with --device"):
        Session(protocol, tmp_path / "out", "P01", device="Touch")
    Session(protocol, tmp_path / "out", "P02", device="Touch (simulated)").__exit__()
    assert write_report(protocol, tmp_path / "out").people[0].device == device
    report = (tmp_path / "out" / "report.md").read_text()
    assert f"Device of P01: {device}; no hand felt a force" in report and "P02: Touch (simulated)." in report
    assert f"P01,0,{device},true" in (tmp_path / "out" / "trials.csv").read_text().replace('"', "")


def test_the_needle_may_go_in_once_the_ticks_say_that_the_force_is_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a busy computer the ramp and the fade, which grow by ticks, take longer than on the clock, and the tick that
    takes a stimulus may be lost to the page."""
    take = PerceptionSitting.ticks

    def late(sitting: PerceptionSitting, ticks: Ticks, now: float) -> Sequence[BaseModel]:
        seen = ticks[ticks.commands & COMMAND_SCENE == 0]
        return take(sitting, seen, now + 60) if len(seen) else ()

    monkeypatch.setattr(PerceptionSitting, "ticks", late)
    with sat(tmp_path, COMPARES) as (person, _):
        person.reads("The session begins.")
        person.answers("Go on")
        person.goes_through("interval 1")
        person.goes_through("interval 2")
        person.reads("Which one fell more?")


def test_no_consent_no_session(tmp_path: Path) -> None:
    with sat(tmp_path, 'consent = "I agree."\n' + COMPARES) as (person, server):
        person.reads("Do you agree?")
        server.session.call(lambda: server.session.bench.simulated_device.point((0.0, -1.0, 0.0), 1)).result(30)
        wait_until(lambda: server.session.run.loop.latest().buttons[-1] == 1)
        person.page.wait(lambda n=person.page.ticks: person.page.ticks > n + 400)
        person.answers("no")
        person.reads("Then there is no session.")
    assert not list((tmp_path / "out").glob("*"))  # nothing is stored
    with pytest.raises(SessionError, match="has not agreed"):
        Session(load_protocol(tmp_path / "mine.toml"), tmp_path / "out", "P01")


def test_practice_has_remarks_and_no_stimulus_changes_in_the_tissue(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with sat(tmp_path, RIGHT.replace("total = 120", "total = 120\npractice = 2")) as (person, server):
        person.reads("The session begins.")
        edit = server.session.edit
        with monkeypatch.context() as now:
            now.setattr(server.session, "edit", lambda _: [][0])
            person.answers("Go on")
            person.goes_through("interval 1")
            person.reads("Something went wrong, but not by you.")
            assert ": a defect" in TOLD[-1]

        def inside(loaded: Loaded) -> None:
            monkeypatch.undo()
            skin, run = loaded.scene.membranes[0], server.session.run
            server.session.bench.simulated_device.move_to(np.add(skin.point, 0.001 * np.array(skin.inward_normal)))
            wait_until(lambda: run.loop.latest().depth[-1, 0] > 0)
            edit(loaded)

        monkeypatch.setattr(server.session, "edit", inside)
        person.answers("Go on")
        person.goes_through("interval 1")
        person.goes_through("interval 2")
        person.reads("The needle was in the tissue too early. The trial is repeated.")
        person.answers("Go on")
        for wrong, remark in ((False, "Right. "), (True, "No, it was another one. ")):
            person.goes_through("interval 1")
            person.goes_through("interval 2")
            person.reads("Which one fell more?")
            right = server.session.sitting._trial.position
            person.answers(person.now["answers"][right ^ wrong]["name"])
            person.reads(remark)


def test_a_trial_that_was_not_felt_as_planned_is_repeated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By a limit, by a fault, without force, on a full disk; and an answer that the disk does not take is asked for
    again."""
    folder = tmp_path / "a; free some space"
    (folder / "out").mkdir(parents=True)
    left, others = (folder / "out" / f"P01-0000-{name}.parquet" for name in ("7", "0005-1"))  # P01's, P01-0000's
    for file in (left, others):
        file.write_bytes(b"")
    words = '[words]\nfault = "Das Gerät hält."\n'
    with sat(folder, YES + words, ForceLimits(max_force=0.2)) as (person, server):
        person.reads("The session begins.")
        person.answers("Go on")
        person.goes_through(depth=0.001)
        person.goes_through("Not through yet: push deeper.")
        person.reads("The device could not give the whole force: push more slowly, and rest a moment. The trial is")
        why = "the peak limit cut the force: let the motors cool, or plan a study with less force"
        assert TOLD[-1] == f"trial 1 of P01 is repeated: {why}"
        person.answers("Go on")
        person.reads("push")
        assert {file.name[:10] for file in (folder / "out").glob("*.parquet*")} == {"P01-0000-2", others.name[:10]}
        assert person.page.ask(do="trip_fault")["ok"]
        person.reads("Das Gerät hält.")
        server.session.bench.settings = Settings("simulated", limits=RunLimits(gate=LATE_ALLOWED))
        person.answers("Go on")
        person.reads("push")
        server.session.run.loop.pause()  # as without the dead-man's button
        person.goes_through()
        person.reads("The force was not on yet: wait a moment before you push. The trial is repeated. Hold")
        full, write = OSError(errno.ENOSPC, "No space left"), AppendFile.write
        with monkeypatch.context() as now:
            now.setattr("punctura.record.writer.LAST_TRIES_S", 0.1)
            now.setattr(AppendFile, "write", lambda file, data: raised(full) if file.size else write(file, data))
            person.answers("Go on")
            person.goes_through()
            person.reads("The session has paused. Please call the experimenter.")
            part = folder / "out" / "P01-0000-4.parquet.part"
            assert TOLD[-1] == f"{part} could not be written: No space left on device; {REMEDY}"
        person.answers("Go on")
        person.goes_through()
        person.reads("Did it pop?")
        add = Session.add
        monkeypatch.setattr(Session, "add", lambda *_: raised(DiskFullError("P01.jsonl: full; free some space")))
        person.answers("yes")
        person.reads("The session has paused. Please call the experimenter.")
        assert TOLD[-1] == 'P01.jsonl: full; free some space, then press "Go on" at the page'
        monkeypatch.setattr(Session, "add", add)
        person.answers("Go on")
        person.reads("Trial 2")
    assert [line.answer for line in saved(folder)] == ["yes"]


def test_a_file_that_cannot_be_deleted_and_a_defect_lead_to_go_on_and_move_no_answer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    left = tmp_path / "out" / "P01-0001-7.parquet"
    left.mkdir(parents=True)
    with sat(tmp_path, YES) as (person, _):
        person.reads("The session begins.")
        person.answers("Go on")
        with monkeypatch.context() as now:
            now.setattr("punctura.studio.sitting.felt_of", lambda *_: [][0])
            person.goes_through()
            person.reads("Something went wrong, but not by you.")
            assert ": a defect" in TOLD[-1]
        person.answers("Go on")
        person.goes_through()
        person.reads("Did it pop?")
        person.answers("yes")
        person.reads("The session has paused.")
        assert TOLD[-1].startswith(f"{left}: ")
        left.rmdir()
        person.answers("Go on")
        person.goes_through("Trial 2")
        person.reads("Did it pop?")
        monkeypatch.setattr(Session, "next", lambda _: [][0])
        given = {"do": "respond", "question": person.now["question"], "answer": "no"}
        assert not person.page.ask(**given)["ok"]
        monkeypatch.undo()
        assert person.page.ask(**given)["ok"]
    assert [line.answer for line in saved(tmp_path)] == ["yes", "no"]


def test_after_every_loss_of_the_force_there_is_a_way_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with sat(tmp_path, YES) as (person, server):
        person.reads("The session begins.")
        assert person.page.ask(do="trip_fault")["ok"]
        person.page.wait(lambda: server.session.run.fault != Fault.none)
        assert not any(person.page.ask(do=wish)["ok"] for wish in ("arm", "reset"))  # no force between the trials
        person.answers("Go on")
        person.reads("The device has stopped its force. If that happens again, please call the experimenter. The force")
        assert TOLD[-1].endswith('its calibration and the unit, m; "Go on" at the page turns the force on again')
        person.answers("Go on")
        person.reads("Hold the needle")
        assert person.page.ask(do="pause")["ok"]
        person.reads("The force was turned off. The trial is repeated.")
        with monkeypatch.context() as now:
            now.setattr(Run, "start", lambda _: raised(DeviceError("cannot open")))
            person.answers("Go on")
            person.reads("The session has paused.")
            assert TOLD[-1] == f"cannot open; {REMEDY}"
        person.answers("Go on")
        person.reads("push")
        with monkeypatch.context() as now:
            now.setattr(Run, "start", lambda _: raised(DeviceError("cannot open")))
            assert person.page.ask(do="trip_fault")["ok"]
            person.reads("The device has stopped its force.")
        person.answers("Go on")
        person.reads("push")
        with StudioClient(server.address.url) as onlooker:
            assert onlooker.ask(do="pause")["ok"] and not onlooker.ask(do="trip_fault")["ok"]
        person.reads("The force was turned off. The trial is repeated.")
        assert not [said for said in person.page.of("notice") if "still off" in said["text"]]  # "Go on" turns it on
    assert server.session.failure is None


def test_the_buttons_of_a_device_answer_and_an_answer_to_another_question_does_not(tmp_path: Path) -> None:
    magnitude = COMPARES.replace('"two_intervals"', '"magnitude"').replace("reference = 0.41\n", "")
    with sat(tmp_path, magnitude) as (person, server):
        person.reads("The session begins.")
        server.session.call(lambda: server.session.bench.simulated_device.point((0.0, -1.0, 0.0), 1)).result(30)
        person.goes_through()
        person.reads("Which one fell more?")
        for wrong in ({"answer": "0"}, {"answer": "x"}, {"question": 1}):
            person.page.ask(**{"do": "respond", "question": person.now["question"], "answer": "2", **wrong})
        person.answers("2.5")
        person.reads("Trial 2")
    assert [line.answer for line in saved(tmp_path)] == ["2.5"]
