"""A session in a terminal: stimuli on a live simulated device, answers by keys, and the verbs."""

from __future__ import annotations

import csv
import json
import wave
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from protocols import COMPARES, YES, written
from punctura import Scene
from punctura._core import Device, ForceLimits, SimulatedDevice, Strokes
from punctura.cli import main
from punctura.live import RunLimits, stroke_ends
from punctura.perception import DiskFullError, Session, delete_participant, load_protocol, read_session
from punctura.perception.report import write_report
from punctura.perception.table import DICTIONARY
from punctura.perception.terminal import READY, Terminal, run_session
from punctura.record import open_recording

SCALED = '[values]\n"display.force_scale" = 0.8\n'


def hand(scene: Scene, share: float = 1.0) -> Device:
    """A device whose hand makes one stroke, as fast as it can. share: of the way."""
    start, end = stroke_ends(scene)
    end = tuple(a + share * (b - a) for a, b in zip(start, end, strict=True))
    motion = Strokes(start, end, count=1, duration=0.8, rest=0.6)
    return SimulatedDevice(
        motion, rate=scene.servo.rate, real_time=False, ticks=2600, axis=scene.membranes[0].inward_normal
    )


class Person:
    """Types its lines one after the other, and keeps what it reads."""

    def __init__(self, typed: list[str], open_device: Callable[[Scene], Device] = hand) -> None:
        self.read: list[str] = []
        self._typed: Iterator[str] = iter(typed)
        self.terminal = Terminal(self.read.append, self._ask, open_device)

    def _ask(self, text: str) -> str:
        self.read.append(text)
        if text.endswith(READY):
            return ""
        typed = next(self._typed, None)
        if typed is None:
            raise EOFError
        return typed


def test_a_session_by_keys_is_recorded_and_goes_on(tmp_path: Path) -> None:
    protocol = load_protocol(written(tmp_path, 'consent = "I agree."\n' + COMPARES + SCALED))
    person = Person(["yes", "x", "2", "1"])
    with pytest.raises(EOFError):
        run_session(protocol, tmp_path / "out", "P01", person.terminal)
    assert any("Type one of the keys 1, 2" in line for line in person.read)
    header, first, second = read_session(tmp_path / "out" / "P01.jsonl")
    assert header["consent"] and (first["answer"], second["answer"]) == ("second", "first")
    assert len(first["felt"]) == len(first["recordings"]) == 2
    levels = [protocol.reference, protocol.reference]
    levels[first["position"]] = first["level"]
    for level, felt, name in zip(levels, first["felt"], first["recordings"], strict=True):
        assert felt["scale"] == 0.8 and felt["pops"] == 1
        opened = open_recording(tmp_path / "out" / name)
        assert opened.info.scene.membranes[0].membrane.precompression == level
    more, less = (0, 1) if levels[0] > levels[1] else (1, 0)  # the first level is not the reference
    assert first["felt"][more]["drop"] > first["felt"][less]["drop"] + 0.01
    again = Person(["yes", "1"])
    with pytest.raises(EOFError):
        run_session(protocol, tmp_path / "out", "P01", again.terminal)
    assert any(line.startswith("2 of 120 trials are done") for line in again.read)
    assert [line["trial"] for line in read_session(tmp_path / "out" / "P01.jsonl")[1:]] == [0, 1, 2]


def test_no_consent_no_session(tmp_path: Path) -> None:
    protocol = load_protocol(written(tmp_path, 'consent = "I agree."\n' + COMPARES + SCALED))
    with pytest.raises(Exception, match="has not agreed"):
        run_session(protocol, tmp_path / "out", "P01", Person(["no"]).terminal)
    assert not (tmp_path / "out").exists()


def test_an_interval_that_was_not_explored_is_repeated(tmp_path: Path) -> None:
    protocol = load_protocol(written(tmp_path, YES + SCALED))
    shares = iter([1.0, 0.6, 1.0, 1.0])  # the first device tells its ratings alone
    person = Person(["", "y"], lambda scene: hand(scene, next(shares)))
    with pytest.raises((EOFError, StopIteration)):
        run_session(protocol, tmp_path / "out", "P01", person.terminal)
    (repeated,) = [line for line in person.read if line.startswith("The trial is repeated")]
    assert "did not go through the thin membrane. Press Enter" in repeated
    lines = read_session(tmp_path / "out" / "P01.jsonl")[1:]
    assert len(lines) == 1 and len(lines[0]["recordings"]) == 1


def test_a_force_that_a_limit_cut_is_repeated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    protocol = load_protocol(written(tmp_path, YES + SCALED))
    monkeypatch.setattr("punctura.perception.terminal.check_device", lambda *_: None)
    person = Person([])
    person.terminal = person.terminal._replace(limits=RunLimits(ForceLimits(max_force=0.2)))
    with pytest.raises(EOFError):  # nothing comes before a person presses Enter
        run_session(protocol, tmp_path / "out", "P01", person.terminal)
    assert any("repeated: the force was cut by the peak limit" in line for line in person.read)
    assert not list((tmp_path / "out").glob("*.parquet"))


def test_what_a_kill_left_of_a_recording_gives_way_and_is_deleted_with_the_participant(tmp_path: Path) -> None:
    protocol, folder = load_protocol(written(tmp_path, YES + SCALED)), tmp_path / "out"
    with pytest.raises(EOFError):
        run_session(protocol, folder, "P01", Person([]).terminal)
    (recording,) = folder.glob("*.parquet")  # of a trial without an answer
    part = folder / f"{recording.name}.part"
    part.write_bytes(b"no recording" * 10)
    with pytest.raises(EOFError):
        run_session(protocol, folder, "P01", Person(["y"]).terminal)
    assert len(read_session(folder / "P01.jsonl")) == 2 and not part.exists()
    part.touch()
    delete_participant(folder, "P01")
    assert not list(folder.iterdir())


def test_a_rating_in_practice_is_neither_right_nor_wrong(tmp_path: Path) -> None:
    text = COMPARES.replace('"two_intervals"', '"rating"').replace("reference = 0.41\n", "")
    protocol = load_protocol(written(tmp_path, text.replace("blocks = 2", "blocks = 2\npractice = 1") + SCALED))
    person = Person(["5"])
    with pytest.raises(EOFError):
        run_session(protocol, tmp_path / "out", "P01", person.terminal)
    assert "Right." not in person.read and "That was another one." not in person.read


def test_a_needle_that_begins_in_the_tissue_repeats_the_trial(tmp_path: Path) -> None:
    def inside(scene: Scene) -> Device:
        start, end = stroke_ends(scene)
        behind = tuple(0.1 * a + 0.9 * b for a, b in zip(start, end, strict=True))
        motion = Strokes(behind, end, count=1, duration=0.8, rest=0.6)
        return SimulatedDevice(
            motion, rate=scene.servo.rate, real_time=False, ticks=1000, axis=scene.membranes[0].inward_normal
        )

    protocol, person = load_protocol(written(tmp_path, YES + SCALED)), Person([], inside)
    with pytest.raises(EOFError):
        run_session(protocol, tmp_path / "out", "P01", person.terminal)
    assert any("the device gave no force" in line for line in person.read)


def test_a_full_disk_asks_before_it_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    protocol = load_protocol(written(tmp_path, YES + SCALED))
    add, full = Session.add, [True]

    def once(self: Session, *given: object) -> None:
        if full.pop():
            full.append(False)
            raise DiskFullError("the disk is full")
        full.append(False)
        add(self, *given)  # type: ignore[arg-type]

    monkeypatch.setattr(Session, "add", once)
    person = Person(["y", ""])
    with pytest.raises(EOFError):
        run_session(protocol, tmp_path / "out", "P01", person.terminal)
    assert "the disk is full. Press Enter to save it again: " in person.read
    assert len(read_session(tmp_path / "out" / "P01.jsonl")) == 2


def call(capsys: pytest.CaptureFixture[str], *words: object) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as end:
        main(["perception", *map(str, words)])
    done = capsys.readouterr()
    return int(end.value.code or 0), done.out, done.err


def test_the_verbs_end_to_end(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = written(tmp_path, YES)
    status, out, _ = call(capsys, "check", file, "--json")
    checked = json.loads(out)
    assert status == 0 and checked["trials"] == 152 and checked["unit"] == "m"
    drops = [level["drop"] for level in checked["levels"]]
    assert drops == sorted(drops, reverse=True)
    status, out, err = call(capsys, "simulate", file, "--people", 2, "--observer", "noise=0.03", "--json")
    found = json.loads(out)
    assert status == 0, err
    assert [one["trials"] for one in found["people"]] == [120, 120]
    folder = tmp_path / "mine.perception"
    again = json.loads(call(capsys, "analyse", file, "--json")[1])
    assert again == found == json.loads((folder / "results.json").read_text())
    table = pq.read_table(folder / "trials.parquet")
    assert table.column_names == [name for name, *_ in DICTIONARY] and table.num_rows == 304
    with (folder / "trials.csv").open() as opened:
        rows = list(csv.DictReader(opened))
    assert len(rows) == 304 and {row["kind"] for row in rows} == {"practice", "trial", "catch"}
    report = (folder / "report.md").read_text()
    assert (
        "| O01 | 120 |" in report
        and "JND" not in report
        and "false alarms" in report
        and (folder / "functions.svg").exists()
    )
    status, out, _ = call(capsys, "delete", file, "O01")
    assert status == 0 and out.count("deleted") == 7
    assert {path.name for path in folder.iterdir()} == {"O02.jsonl"}
    status, _, err = call(capsys, "analyse", file, "--out", tmp_path / "none")
    assert status == 1 and "has no session" in err
    for wrong, words in (("weber=a", "KEY=NUMBER"), ("webber=1", "none of weber, "), ("lapse=2", "from 0 to 1")):
        status, _, err = call(capsys, "power", file, "--observer", wrong)
        assert status == 2 and words in err
    changed = written(tmp_path, YES.replace("seed = 4", "seed = 5"))
    status, _, err = call(capsys, "analyse", changed)
    assert status == 1 and "another protocol or of a changed one" in err


def test_masking_noise_has_as_much_power_in_each_octave(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert call(capsys, "noise", "--out", tmp_path / "noise.wav", "--seconds", 2)[0] == 0
    with wave.open(str(tmp_path / "noise.wav")) as file:
        rate, sound = file.getframerate(), np.frombuffer(file.readframes(file.getnframes()), "<i2").astype(float)
    assert len(sound) == 2 * rate and abs(sound).max() == 32_767
    power, hertz = abs(np.fft.rfft(sound)) ** 2, np.fft.rfftfreq(len(sound), 1 / rate)
    octaves = [power[(hertz >= low) & (hertz < 2 * low)].sum() for low in (100, 400, 1600, 6400)]
    assert octaves == pytest.approx([octaves[0]] * 4, rel=0.02)
    assert abs(sound[0] - sound[-1]) < 5 * np.diff(sound).std()  # it can play in a loop


def test_an_unfinished_session_is_reported_as_too_short(tmp_path: Path) -> None:
    protocol = load_protocol(written(tmp_path, YES))
    with Session(protocol, tmp_path, "P01") as session:
        header = session.header
    found = write_report(protocol, {"P01": [header]}, tmp_path / "report")
    assert found.people[0].reason.startswith("0 answers are too few")
    assert "| P01 | 0 | 0 answers" in (tmp_path / "report" / "report.md").read_text()
