"""Sessions on disk: no answered trial is lost, and the order goes on as planned."""

from __future__ import annotations

import errno
import json
import os
import random
from pathlib import Path

import pytest
from protocols import COMPARES, RIGHT, written
from punctura.perception import (
    DiskFullError,
    Observer,
    Session,
    SessionError,
    Simulation,
    delete_participant,
    load_protocol,
    read_session,
)
from punctura.perception.observer import Senses
from punctura.perception.report import report_of_folder


@pytest.fixture(scope="module")
def senses(tmp_path_factory: pytest.TempPathFactory) -> Senses:
    return Senses(load_protocol(written(tmp_path_factory.mktemp("quest"), RIGHT)))


def trials(path: Path) -> list[dict[str, object]]:
    return [{key: value for key, value in line.items() if key != "time"} for line in read_session(path)[1:]]


def test_a_session_cut_at_any_byte_goes_on_as_planned(tmp_path: Path, senses: Senses) -> None:
    """QUEST+ needs all earlier answers for its next level, so a lost one would change the rest."""
    simulation = Simulation(senses.protocol, Observer(), senses)
    simulation.run_on_disk(tmp_path / "whole", "P01", 7)
    wanted = trials(tmp_path / "whole" / "P01.jsonl")
    data = (tmp_path / "whole" / "P01.jsonl").read_bytes()
    path = tmp_path / "cut" / "P01.jsonl"
    path.parent.mkdir()
    for end in [*random.Random(1).sample(range(len(data)), 18), 0, len(data) - 1]:
        path.write_bytes(data[:end])
        answered = max(data[:end].count(b"\n") - 1, 0)
        with Session(senses.protocol, path.parent, "P01") as session:
            assert session.kept == answered
        simulation.run_on_disk(path.parent, "P01", 7)
        assert trials(path) == wanted


def test_a_full_disk_pauses_the_session(tmp_path: Path, senses: Senses, monkeypatch: pytest.MonkeyPatch) -> None:
    simulation = Simulation(senses.protocol, Observer(), senses)
    write = os.write

    def full(descriptor: int, data: bytes) -> int:
        write(descriptor, data[:10])  # what still had room
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with Session(senses.protocol, tmp_path, "P01") as session:
        trial = session.next()
        assert trial is not None
        given = simulation.answer(trial, 7)
        with monkeypatch.context() as patched:
            patched.setattr(os, "write", full)
            with pytest.raises(DiskFullError, match="free some space"):
                session.add(trial, *given)
        assert session.next() == trial
        session.add(trial, *given)
    assert [line["trial"] for line in read_session(tmp_path / "P01.jsonl")[1:]] == [0]


def test_what_is_no_session_of_the_protocol_is_refused(tmp_path: Path, senses: Senses) -> None:
    protocol = senses.protocol
    for name in ("", "Ada Lovelace", "../P01", ".hidden", "P" * 41):
        with pytest.raises(SessionError, match="no pseudonym"):
            Session(protocol, tmp_path, name)
    other = tmp_path / "other"
    other.mkdir()
    changed = load_protocol(written(other, COMPARES))
    with Session(protocol, tmp_path, "P01"), pytest.raises(SessionError, match="another program runs"):
        Session(protocol, tmp_path, "P01")
    with pytest.raises(SessionError, match="another protocol or of a changed one"):
        Session(changed, tmp_path, "P01")
    path = tmp_path / "P02.jsonl"
    path.write_text('{"a": 1}\n')
    with pytest.raises(SessionError, match="line 1: is no line of a session"):
        Session(protocol, tmp_path, "P02")
    assert path.read_text() == '{"a": 1}\n'


def test_an_order_that_is_not_this_one_is_not_continued(tmp_path: Path, senses: Senses) -> None:
    simulation = Simulation(senses.protocol, Observer(), senses)
    simulation.run_on_disk(tmp_path, "P01", 7)
    path = tmp_path / "P01.jsonl"
    lines = path.read_text().splitlines()
    fifth = json.loads(lines[5])
    lines[5] = json.dumps(fifth | {"position": 1 - fifth["position"]})
    path.write_text("\n".join(lines) + "\n")
    with pytest.raises(SessionError, match="trial 4 is not the one"):
        Session(senses.protocol, tmp_path, "P01")


@pytest.mark.parametrize(
    "wrong", [{"answer": "maybe"}, {"position": 7}, {"level": 9.9}, {"felt": []}, {"trial": 3}, {"kind": ""}]
)
def test_a_trial_that_was_changed_by_hand_is_not_analysed(
    tmp_path: Path, senses: Senses, wrong: dict[str, object]
) -> None:
    Simulation(senses.protocol, Observer(), senses).run_on_disk(tmp_path, "P01", 7)
    path = tmp_path / "P01.jsonl"
    lines = path.read_text().splitlines()
    lines[5] = json.dumps(json.loads(lines[5]) | wrong)
    path.write_text("\n".join(lines) + "\n")
    with pytest.raises(SessionError, match="line 6: is no trial of this session"):
        report_of_folder(senses.protocol, tmp_path)
    path.rename(tmp_path / "P02.jsonl")
    with pytest.raises(SessionError, match="is the session of P01"):
        report_of_folder(senses.protocol, tmp_path)


def test_people_and_observers_have_their_own_folders(tmp_path: Path, senses: Senses) -> None:
    Simulation(senses.protocol, Observer(), senses).run_on_disk(tmp_path, "O01", 7)
    with pytest.raises(SessionError, match="simulated observers, and no report may mix both"):
        Session(senses.protocol, tmp_path, "P01")


def test_participants_have_their_own_numbers_and_can_be_deleted(tmp_path: Path, senses: Senses) -> None:
    numbers = []
    for name in ("P01", "P02"):
        with Session(senses.protocol, tmp_path, name) as session:
            numbers.append(session.header["number"])
    assert numbers == [0, 1] and (tmp_path / "P01.jsonl").stat().st_mode & 0o077 == 0
    recording, beside = tmp_path / "P01-0000-1.parquet", tmp_path.parent / "P01-0000-1.parquet"
    recording.touch()
    beside.touch()
    with Session(senses.protocol, tmp_path, "P01") as session:
        trial = session.next()
        assert trial is not None
        felt = Simulation(senses.protocol, Observer(), senses).answer(trial, 1)
        session.add(trial, *felt, recordings=[recording.name, f"../{recording.name}"])
    assert set(delete_participant(tmp_path, "P01")) == {recording, tmp_path / "P01.jsonl"}
    assert beside.exists() and (tmp_path / "P02.jsonl").exists()
    with pytest.raises(SessionError, match="has no participant"):
        delete_participant(tmp_path, "P01")
    with Session(senses.protocol, tmp_path, "P03") as session:
        assert session.header["number"] == 0
