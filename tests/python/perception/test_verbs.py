"""The verbs, from a protocol to a report."""

from __future__ import annotations

import csv
import io
import json
import wave
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from protocols import YES, written
from punctura.cli import main
from punctura.perception import Session, load_protocol
from punctura.perception.noise import pink_noise
from punctura.perception.report import write_report
from punctura.perception.table import DICTIONARY


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
    report, picture = ((folder / name).read_text() for name in ("report.md", "functions.svg"))
    assert "| O01 | 120 |" in report and "JND" not in report and "false alarms" in report
    assert "<!-- thickness of the thin membrane, mm -->" in picture
    status, out, _ = call(capsys, "delete", file, "O01")
    assert status == 0 and out.count("deleted") == 7
    assert {path.name for path in folder.iterdir()} == {"O02.jsonl"}
    status, _, err = call(capsys, "analyse", file, "--out", tmp_path / "none")
    assert status == 2 and "there is no folder" in err
    for wrong, words in (("weber=a", "KEY=NUMBER"), ("webber=1", "none of weber, "), ("lapse=2", "from 0 to 1")):
        status, _, err = call(capsys, "power", file, "--observer", wrong)
        assert status == 2 and words in err
    changed = written(tmp_path, YES.replace("seed = 4", "seed = 5"))
    status, _, err = call(capsys, "analyse", changed)
    assert status == 1 and "another protocol or of a changed one" in err


def test_masking_noise_has_as_much_power_in_each_octave() -> None:
    with wave.open(io.BytesIO(pink_noise(2))) as file:
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
    write_report(protocol, {"P01": [header]}, tmp_path / "report")
    assert "| P01 | 0 | 0 answers are too few" in (tmp_path / "report" / "report.md").read_text()
