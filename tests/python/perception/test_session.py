"""Sessions on disk: no answered trial is lost, and the order goes on as planned. The verbs, from protocol to report."""

import csv
import errno
import json
import os
import random
import re
from collections.abc import Callable
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from protocols import COMPARES, RIGHT, YES, written
from punctura import __version__
from punctura.defects import explain
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
from punctura.perception.analysis import analyse
from punctura.perception.observer import Senses
from punctura.perception.report import DICTIONARY, write_report
from punctura.perception.results import Analysis
from punctura.perception.session import agreed
from punctura.scene.ready import scene_path


@pytest.fixture(scope="module")
def senses(tmp_path_factory: pytest.TempPathFactory) -> Senses:
    return Senses(load_protocol(written(tmp_path_factory.mktemp("quest"), RIGHT)))


def trials(path: Path) -> list[dict]:
    return [line.model_dump(exclude={"time"}) for line in read_session(path)[1]]


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
    assert [line.trial for line in read_session(tmp_path / "P01.jsonl")[1]] == [0]


def test_a_full_disk_has_its_remedy_in_the_message_about_a_table(
    tmp_path: Path, senses: Senses, monkeypatch: pytest.MonkeyPatch
) -> None:
    Session(senses.protocol, tmp_path, "P01").__exit__()

    def full(schema: object, where: Path) -> None:
        raise OSError(errno.ENOSPC, "Error writing bytes to file. Detail: [errno 28] No space left on device")

    monkeypatch.setattr("punctura.ticks.files.CsvOutput", full)  # as Arrow says it
    with pytest.raises(OSError, match="No space left on device") as bad:
        write_report(senses.protocol, tmp_path)
    assert explain(bad.value) == f"{tmp_path / 'trials.csv'}: {os.strerror(errno.ENOSPC)}; free some space"


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
    with pytest.raises(SessionError, match="line 1: is no line of this session"):
        Session(protocol, tmp_path, "P02")
    assert path.read_text() == '{"a": 1}\n'


def changed(folder: Path, senses: Senses, wrong: Callable[[dict], dict]) -> Path:
    """A session whose sixth line was changed by hand."""
    Simulation(senses.protocol, Observer(), senses).run_on_disk(folder, "P01", 7)
    path = folder / "P01.jsonl"
    lines = path.read_text().splitlines()
    line = json.loads(lines[5])
    lines[5] = json.dumps(line | wrong(line))
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (lambda line: {"position": 1 - line["position"]}, "line 6: position is [01], and [01] is planned.*: restore"),
        (lambda line: {"block": 3}, "line 6: block is 3, and 0 is planned"),
        (lambda line: {"kind": "catch"}, "line 6: kind is 'catch', and 'trial' is planned"),
        (lambda line: {"kind": ""}, "line 6: is no line of this session"),
        (lambda line: {"answer": "maybe"}, "line 6: 'maybe' to 2 intervals is no answer"),
        (lambda line: {"felt": [one | {"peak": 1e300} for one in line["felt"]]}, "line 6: is no line of this session"),
        (lambda line: {"felt": []}, "line 6: 'first|second' to 0 intervals is no answer"),
        (lambda line: {"recordings": ["P02-0004-1.parquet"]}, "'P02-0004-1.parquet' is the name of another trial's"),
        (lambda line: {"answer": {"first": "second", "second": "first"}[line["answer"]]}, r"line \d+: level is "),
    ],
)
def test_a_trial_that_was_changed_by_hand_is_told_and_neither_analysed_nor_continued(
    tmp_path: Path, senses: Senses, wrong: Callable[[dict], dict], words: str
) -> None:
    """Another answer of QUEST+ leads to other levels."""
    path = changed(tmp_path, senses, wrong)
    with pytest.raises(SessionError, match=words):
        write_report(senses.protocol, tmp_path)
    with pytest.raises(SessionError, match=words):
        Session(senses.protocol, tmp_path, "P01")
    path.rename(tmp_path / "P02.jsonl")
    with pytest.raises(SessionError, match=r"is the session of P01|is no line"):
        write_report(senses.protocol, tmp_path)


def test_a_participant_who_is_deleted_during_the_analysis_is_in_no_table(
    tmp_path: Path, senses: Senses, monkeypatch: pytest.MonkeyPatch
) -> None:
    Simulation(senses.protocol, Observer(), senses).run_on_disk(tmp_path, "P01", 7)
    (tmp_path / "trials.csv").write_text("P01")

    def deleted(*given: object) -> Analysis:
        (tmp_path / "P01.jsonl").unlink()
        return analyse(*given)

    monkeypatch.setattr("punctura.perception.report.analyse", deleted)
    with pytest.raises(SessionError, match="P01 was deleted during the analysis: run it again"):
        write_report(senses.protocol, tmp_path)
    assert not [*tmp_path.iterdir()]


def test_an_unfinished_session_and_observers_beside_people_are_told(tmp_path: Path, senses: Senses) -> None:
    path = changed(tmp_path, senses, lambda line: {})
    whole = path.read_text().splitlines(keepends=True)
    assert not write_report(senses.protocol, tmp_path).people[0].planned
    path.write_text("".join(whole[:100]))
    assert write_report(senses.protocol, tmp_path).people[0].planned == senses.protocol.file.scored
    report = (tmp_path / "report.md").read_text()
    assert "| P01 | 99 of 120 |" in report and "Not finished: P01. What is there is analysed" in report
    header = json.loads(whole[0]) | {"participant": "P02", "simulated": False}
    (tmp_path / "P02.jsonl").write_text(json.dumps(header) + "\n")
    with pytest.raises(SessionError, match="the folder has sessions of people, and no report may mix both"):
        write_report(senses.protocol, tmp_path)


def test_another_version_is_named(tmp_path: Path, senses: Senses) -> None:
    path = changed(tmp_path, senses, lambda line: {})
    header, first, *rest = path.read_text().splitlines()
    header = json.dumps(json.loads(header) | {"version": "0.1"})
    path.write_text("\n".join([header, first, *rest]) + "\n")
    write_report(senses.protocol, tmp_path)
    assert f"P01 began with Punctura 0.1, and this is {__version__}" in (tmp_path / "report.md").read_text()
    path.write_text("\n".join([header, *rest, first]) + "\n")
    with pytest.raises(SessionError, match=r"line 2: trial is 1, and 0 is planned.*: use Punctura 0\.1, which"):
        write_report(senses.protocol, tmp_path)


def test_a_session_under_two_names_counts_once_and_equal_numbers_are_told(tmp_path: Path, senses: Senses) -> None:
    simulation = Simulation(senses.protocol, Observer(), senses)
    for folder, name, seed in ((tmp_path, "P01", 7), (tmp_path / "other", "P03", 8)):
        simulation.run_on_disk(folder, name, seed)
    (tmp_path / "other" / "P03.jsonl").rename(tmp_path / "P03.jsonl")
    again = (tmp_path / "P01.jsonl").read_text().replace('"participant":"P01"', '"participant":"P02"')
    (tmp_path / "P02.jsonl").write_text(again)
    found = write_report(senses.protocol, tmp_path)
    one, two, three = found.people
    assert two.copy_of == "P01" and two.reason.startswith("the session of P01 under another name, not counted: delete")
    assert found.threshold and one.threshold and three.threshold
    assert found.threshold.value == pytest.approx((one.threshold.value + three.threshold.value) / 2)
    report = (tmp_path / "report.md").read_text()
    assert "| **mean of 2 of 2 people** |" in report and "P01 and P03 have the same number, 0, and so" in report
    assert "P02" not in (tmp_path / "trials.csv").read_text()


def test_participants_have_their_own_numbers_and_can_be_deleted(
    tmp_path: Path, senses: Senses, monkeypatch: pytest.MonkeyPatch
) -> None:
    numbers = []
    for name in ("P01", "P02"):
        with Session(senses.protocol, tmp_path, name) as session:
            numbers.append(session.header.number)
    assert write_report(senses.protocol, tmp_path).people[0].reason.startswith("0 answers are too few")
    assert numbers == [0, 1] and (tmp_path / "P01.jsonl").stat().st_mode & 0o077 == 0
    recording = tmp_path / "P01-0000-1.parquet"
    recording.touch()
    with Session(senses.protocol, tmp_path, "P01") as session:
        trial = session.next()
        assert trial is not None
        felt = Simulation(senses.protocol, Observer(), senses).answer(trial, 1)
        sync, synced = os.fsync, set()
        monkeypatch.setattr(os, "fsync", lambda file: (synced.add(os.fstat(file).st_ino), sync(file)))
        session.add(trial, *felt, recordings=[recording.name])
        assert {file.stat().st_ino for file in (tmp_path, recording, session.path)} <= synced  # after a loss of power
        with pytest.raises(SessionError, match="end it first"):  # later answers would be lost
            delete_participant(tmp_path, "P01")
    assert {recording, tmp_path / "P01.jsonl"} < set(delete_participant(tmp_path, "P01"))
    assert {path.name for path in tmp_path.iterdir()} == {"P02.jsonl"}
    with pytest.raises(SessionError, match="has no participant"):
        delete_participant(tmp_path, "P01")
    with Session(senses.protocol, tmp_path, "P03") as session:
        assert session.header.number == 0


def test_the_verbs_end_to_end(tmp_path: Path, punctura: Callable[..., tuple[int, str, str]]) -> None:
    file = written(tmp_path, YES)
    status, out, _ = punctura("perception", "check", file, "--json")
    checked = json.loads(out)
    assert status == 0 and checked["trials"] == 152 and checked["unit"] == "m"
    drops = [level["drop"] for level in checked["levels"]]
    assert drops == sorted(drops, reverse=True)
    assert "Was there a pop?: scene k06-fig10, 152 trials" in punctura("perception", "check", file)[1]
    status, out, err = punctura("perception", "simulate", file, "--people", 2, "--observer", "noise=0.03", "--json")
    found = json.loads(out)
    assert status == 0, err
    assert [one["trials"] for one in found["people"]] == [120, 120]
    folder = tmp_path / "mine.perception"
    again = json.loads(punctura("perception", "analyse", file, "--json")[1])
    assert again == found == json.loads((folder / "results.json").read_text())
    table = pq.read_table(folder / "trials.parquet")
    assert table.column_names == [name for name, *_ in DICTIONARY] and table.num_rows == 304
    assert '"level","double","m","planned' in (folder / "dictionary.csv").read_text()
    with (folder / "trials.csv").open() as opened:
        rows = list(csv.DictReader(opened))
    assert len(rows) == 304 and {row["kind"] for row in rows} == {"practice", "trial", "catch"}
    report, picture = ((folder / name).read_text() for name in ("report.md", "functions.svg"))
    assert "| O01 | 120 |" in report
    assert "| level, m | O01, trials | O01, d' | " in report and re.search(r"\n\| 0\.0027 \| 20 \| ", report)
    assert "JND" not in report and "false alarms" in report and "Bar: that" in report
    assert "About 12 times as many such trials would most likely close it" in report
    assert "<!-- thickness of the thin membrane, mm -->" in picture
    html = (folder / "report.html").read_text()
    assert "<tr><td>O01<td>120<td>" in html and "<svg" in html and "functions.svg" not in html
    status, out, _ = punctura("perception", "delete", file, "O01")
    assert status == 0 and out.count("deleted") == 8
    assert {path.name for path in folder.iterdir()} == {"O02.jsonl"}
    status, _, err = punctura("perception", "analyse", file, "--out", tmp_path / "none")
    assert status == 2 and "there is no folder" in err
    for wrong, words in (("weber", "as weber=0.1"), ("webber=1", "none of weber, "), ("lapse=2", "from 0 to 1")):
        status, _, err = punctura("perception", "power", file, "--observer", wrong)
        assert status == 2 and words in err
    changed = written(tmp_path, YES.replace("seed = 4", "seed = 5"))
    status, _, err = punctura("perception", "analyse", changed)
    assert status == 1 and "another protocol or of a changed one" in err
    with pytest.raises(SessionError, match="simulated observers, and no report may mix both"):
        agreed(load_protocol(changed), folder, "P01")  # before a person is asked to agree


def test_a_text_that_is_not_ours_is_no_part_of_a_report(tmp_path: Path) -> None:
    """Neither of its HTML nor of its Markdown: no script, no link, no table, no line of its own."""
    title = "A <script>alert(1)</script> & ![b](http://x.example/y.png) | c\\n\\n# Another"
    text = YES.replace("Was there a pop?", title).replace("[stimulus]", 'source = "<img src=x>"\n[stimulus]', 1)
    protocol = load_protocol(written(tmp_path, text))
    Session(protocol, tmp_path, "P01", device="<b>Touch</b>").__exit__()
    write_report(protocol, tmp_path)
    for name in ("report.md", "report.html"):
        report = (tmp_path / name).read_text()
        assert (
            "A &lt;script&gt;alert(1)&lt;/script&gt; &amp; ![b]&#40;http://x.example/y.png) &#124; c # Anot" in report
        )
        assert "&lt;img src=x&gt;" in report and "&lt;b&gt;Touch&lt;/b&gt;" in report


def test_the_name_of_a_membrane_is_no_formula_of_the_picture(tmp_path: Path) -> None:
    text = scene_path("k06-fig10").read_text().replace("thin membrane", "$skin^$")
    (tmp_path / "own.toml").write_text(text)
    protocol = load_protocol(written(tmp_path, YES.replace("k06-fig10", "own.toml")))
    Simulation(protocol, Observer(noise=0.03)).run_on_disk(tmp_path / "out", "O01", 1)
    assert write_report(protocol, tmp_path / "out").people[0].reason == ""
    assert "<!-- thickness of the $skin^$, mm -->" in (tmp_path / "out" / "functions.svg").read_text()


def test_a_report_says_what_so_few_answers_do_not_tell(tmp_path: Path) -> None:
    rating = COMPARES.replace('"two_intervals"', '"rating"').replace("reference = 0.41\n", "")
    for name, few in (("chatter", True), (written(tmp_path, rating), False)):
        simulation = Simulation(load_protocol(name), Observer(weber=0.0, noise=0.0008))
        simulation.run_on_disk(tmp_path / str(few), "O01", 1)
        assert write_report(simulation.protocol, tmp_path / str(few)).people[0].reason == ""
        report = (tmp_path / str(few) / "report.md").read_text()
        assert few == ("24 answers at a level do not tell which" in report) == ("for people who seldom lapse" in report)
